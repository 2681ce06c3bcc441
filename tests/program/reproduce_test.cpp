#include <gtest/gtest.h>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;
using namespace testing;  // NOLINT: helpers of the tests
using Words = std::vector<std::string>;

/// `mms reproduce` on small scenes with more arguments.
Outcome reproduce(const TempFolder& folder, const Words& more = {}) {
  Words words = {"reproduce",    "sim:still_walker?width=320",
                 "--trajectory", "sim:crowd?width=320",
                 "--frames",     "6",
                 "-o",           "out",
                 "--segmenter",  "masks"};
  words.insert(words.end(), more.begin(), more.end());
  return run_mms(folder.path(), words);
}

/// Writes the files of benchmarks/table1.sh for one training.
void write_training(const TempFolder& folder, const std::string& name, double ap) {
  const std::string value = std::to_string(ap);
  folder.write("runs/" + name + "/ap.json", "{\"AP\": " + value +
                                                ", \"per_class\": {\"person\": {\"AP\": " + value +
                                                "}, \"agv\": {\"AP\": " + value + "}}}");
  folder.write("runs/" + name + "/ms", "12.5\n");
}

TEST(Reproduce, WritesPaperTablesIntoReport) {
  const TempFolder folder;
  write_training(folder, "solov2-1", 0.4);
  write_training(folder, "solov2-2", 0.5);
  write_training(folder, "solov2+rfp-1", 0.6);
  const Outcome outcome = reproduce(folder, {"--trainings", "runs"});
  expect_success(outcome);
  const auto tables = json_file(folder.path() / "out/reproduction.json")["tables"];
  ASSERT_EQ(tables.size(), 4U);
  EXPECT_EQ(tables[0]["rows"][0],
            (Words{"SOLOv2", "2", "45.0", "45.0", "45.0", "12.5", "38.8", "54.0"}));
  EXPECT_EQ(tables[0]["rows"].size(), 2U);
  ASSERT_EQ(tables[1]["rows"].size(), 3U);
  EXPECT_EQ(tables[1]["rows"][2][0], "multi-modal");
  EXPECT_EQ(tables[1]["rows"][2][3], "0.875 / 0.502");
  EXPECT_EQ(tables[3]["rows"].size(), 2U);
  const std::string report = read_file(folder.path() / "out/report.html");
  expect_in("Localization comparison", report);
  expect_in("truth", report);
  expect_in("Table II", outcome.out);
  EXPECT_TRUE(fs::exists(folder.path() / "out/still_vision/metrics.json"));
  EXPECT_TRUE(fs::exists(folder.path() / "out/loop_multimodal/semantic_map.ply"));
}

TEST(Reproduce, ErrorsNameInvalidTrainings) {
  const TempFolder folder;
  expect_error(reproduce(folder, {"--trainings", "nowhere"}), "nowhere: is not a folder");
  fs::create_directories(folder.path() / "empty");
  expect_error(reproduce(folder, {"--trainings", "empty"}), "empty: has no finished training");
  folder.write("bad/solov2-1/ap.json", "{}");
  expect_error(reproduce(folder, {"--trainings", "bad"}), "ap.json");
}

}  // namespace
}  // namespace mms
