#include "mms/training/processes/process_place.hpp"

#include <gtest/gtest.h>

#include <map>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using Variables = std::map<std::string, std::string>;

ProcessPlace place_of(const Variables& variables) {
  return process_place([&](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    if (found == variables.end()) return std::nullopt;
    return found->second;
  });
}

TEST(ProcessPlace, IsOneProcessWithoutLauncher) {
  EXPECT_EQ(place_of({}).size, 1);
  EXPECT_EQ(place_of({{"WORLD_SIZE", "1"}}).size, 1);
  // In a batch script Slurm gives the number of tasks of the job, which it has not started.
  EXPECT_EQ(place_of({{"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}}).size, 1);
}

TEST(ProcessPlace, ReadsVariablesOfTorchrun) {
  const Variables variables = {{"WORLD_SIZE", "4"},       {"RANK", "3"},
                               {"LOCAL_RANK", "1"},       {"LOCAL_WORLD_SIZE", "2"},
                               {"MASTER_ADDR", "node01"}, {"MASTER_PORT", "29501"}};
  ProcessPlace place = place_of(variables);
  EXPECT_EQ(place.size, 4);
  EXPECT_EQ(place.rank, 3);
  EXPECT_EQ(place.local_rank, 1);
  EXPECT_EQ(place.local_size, 2);
  EXPECT_EQ(place.address, "node01");
  EXPECT_EQ(place.port, 29501);
  EXPECT_FALSE(place.hosted_by_launcher);
  Variables restarted = variables;
  restarted["TORCHELASTIC_USE_AGENT_STORE"] = "True";
  restarted["TORCHELASTIC_RESTART_COUNT"] = "2";
  place = place_of(restarted);
  EXPECT_TRUE(place.hosted_by_launcher);
  EXPECT_EQ(place.prefix, "attempt_2");
}

TEST(ProcessPlace, ReadsVariablesOfSlurm) {
  Variables variables = {{"SLURM_STEP_NUM_TASKS", "4"},
                         {"SLURM_PROCID", "2"},
                         {"SLURM_LOCALID", "0"},
                         {"SLURM_STEP_NUM_NODES", "2"},
                         {"SLURM_STEP_NODELIST", "node[07-08,12],other"},
                         {"SLURM_JOB_ID", "40123"}};
  const ProcessPlace place = place_of(variables);
  EXPECT_EQ(place.size, 4);
  EXPECT_EQ(place.rank, 2);
  EXPECT_EQ(place.local_size, 2);
  EXPECT_EQ(place.address, "node07");
  EXPECT_EQ(place.port, 29623);
  variables["SLURM_STEP_NODELIST"] = "robot,node[1-3]";
  EXPECT_EQ(place_of(variables).address, "robot");
  variables["SLURM_STEP_NODELIST"] = "node[5]";
  EXPECT_EQ(place_of(variables).address, "node5");
}

TEST(ProcessPlace, ErrorsNameTheVariable) {
  const auto message = [](const Variables& variables) {
    return message_of<ConfigError>([&] { place_of(variables); });
  };
  expect_in("WORLD_SIZE: is '2x', allowed: 1 to 4096", message({{"WORLD_SIZE", "2x"}}));
  expect_in("RANK: is not set", message({{"WORLD_SIZE", "2"}}));
  expect_in("RANK: is '2', allowed: 0 to 1", message({{"WORLD_SIZE", "2"}, {"RANK", "2"}}));
  expect_in("MASTER_PORT: is '0', allowed: 1 to 65535",
            message({{"WORLD_SIZE", "2"}, {"RANK", "0"}, {"MASTER_PORT", "0"}}));
  expect_in("MASTER_ADDR: is not set",
            message({{"WORLD_SIZE", "2"}, {"RANK", "0"}, {"MASTER_PORT", "29500"}}));
}

}  // namespace
}  // namespace mms
