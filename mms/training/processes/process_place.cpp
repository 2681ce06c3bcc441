#include "mms/training/processes/process_place.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr int kMaxProcesses = 4096;     // more is a mistake
constexpr int kMaxPort = 65535;         // of TCP
constexpr int kFirstSlurmPort = 29500;  // torch's default
constexpr int kSlurmPorts = 1000;       // jobs of one machine at the same time get different ones

int number_in(const Environment& environment, const std::string& name, int low, int high) {
  const std::optional<std::string> text = environment(name);
  if (!text) {
    throw ConfigError(name, "is not set",
                      "torchrun sets RANK, WORLD_SIZE, MASTER_ADDR and MASTER_PORT; unset "
                      "WORLD_SIZE for a training with one process");
  }
  int value = 0;
  const auto [end, fault] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (fault != std::errc() || end != text->data() + text->size() || value < low || value > high) {
    throw ConfigError(name, "is '" + *text + "', allowed: " + std::to_string(low) + " to " +
                                std::to_string(high));
  }
  return value;
}

int number_or(const Environment& environment, const std::string& name, int low, int high,
              int otherwise) {
  return environment(name) ? number_in(environment, name, low, high) : otherwise;
}

/// The first host of Slurm's list: `node07` of "node[07-09,12],other".
std::string first_host(const std::string& list) {
  const std::size_t end = list.find_first_of(",[");
  std::string host = list.substr(0, end);
  if (end != std::string::npos && list[end] == '[') {
    host += list.substr(end + 1, list.find_first_of(",-]", end) - end - 1);
  }
  return host;
}

ProcessPlace place_by_torchrun(const Environment& environment) {
  ProcessPlace place;
  place.size = number_in(environment, "WORLD_SIZE", 1, kMaxProcesses);
  if (place.size == 1) return place;
  place.rank = number_in(environment, "RANK", 0, place.size - 1);
  place.local_rank = number_or(environment, "LOCAL_RANK", 0, place.size - 1, 0);
  place.local_size = number_or(environment, "LOCAL_WORLD_SIZE", 1, place.size, 1);
  place.port = number_in(environment, "MASTER_PORT", 1, kMaxPort);
  place.address = environment("MASTER_ADDR").value_or("");
  if (place.address.empty()) {
    throw ConfigError("MASTER_ADDR", "is not set", "the host of the process with RANK 0");
  }
  place.hosted_by_launcher = environment("TORCHELASTIC_USE_AGENT_STORE") == "True";
  if (place.hosted_by_launcher) {
    place.prefix = "attempt_" + environment("TORCHELASTIC_RESTART_COUNT").value_or("0");
  }
  return place;
}

ProcessPlace place_by_slurm(const Environment& environment) {
  ProcessPlace place;
  place.size = number_in(environment, "SLURM_STEP_NUM_TASKS", 1, kMaxProcesses);
  if (place.size == 1) return place;
  place.rank = number_in(environment, "SLURM_PROCID", 0, place.size - 1);
  place.local_rank = number_or(environment, "SLURM_LOCALID", 0, place.size - 1, 0);
  const int nodes = number_or(environment, "SLURM_STEP_NUM_NODES", 1, place.size, 1);
  place.local_size = (place.size + nodes - 1) / nodes;
  const std::string hosts = environment("SLURM_STEP_NODELIST").value_or("localhost");
  place.address = environment("MASTER_ADDR").value_or(first_host(hosts));
  const int job = number_or(environment, "SLURM_JOB_ID", 0, std::numeric_limits<int>::max(), 0);
  place.port =
      number_or(environment, "MASTER_PORT", 1, kMaxPort, kFirstSlurmPort + job % kSlurmPorts);
  return place;
}

}  // namespace

std::optional<std::string> environment_variable(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  if (value == nullptr || *value == '\0') return std::nullopt;
  return std::string(value);
}

ProcessPlace process_place(const Environment& environment) {
  if (environment("WORLD_SIZE")) return place_by_torchrun(environment);
  if (environment("SLURM_STEP_NUM_TASKS")) return place_by_slurm(environment);
  return {};
}

int cores_of(const ProcessPlace& place) {
  const int all = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  const bool known = sched_getaffinity(0, sizeof(allowed), &allowed) == 0;
  const int own = known ? CPU_COUNT(&allowed) : all;
  // A launcher that binds processes to cores has divided them already.
  return std::max(1, own < all ? own : all / place.local_size);
}

}  // namespace mms
