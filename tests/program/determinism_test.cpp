#include <gtest/gtest.h>

#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"
#include "tests/program/recordings.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// Runs data/ with 1, 2, 2 and 4 threads and expects the same bytes each time.
void expect_same_bytes(const TempFolder& folder) {
  const std::vector<std::string> threads = {"1", "2", "2", "4"};
  const std::string masks = segmenter_of(folder.path() / "data");
  for (std::size_t i = 0; i < threads.size(); ++i) {
    const std::string out = "out" + std::to_string(i);
    expect_success(run_mms(
        folder.path(), {"run", "data", "--segmenter", masks, "-o", out, "--threads", threads[i]}));
    for (const char* file :
         {"trajectory.tum", "static_map.ply", "objects.json", "map.pgm", "map.yaml", "map.bt"}) {
      const bool same =
          read_file(folder.path() / "out0" / file) == read_file(folder.path() / out / file);
      EXPECT_TRUE(same) << file << " with --threads " << threads[i] << " in " << out;
    }
  }
}

TEST(Determinism, RgbdRunsGiveSameBytes) {
  const TempFolder folder;
  SceneConfig config = small_scene(12);
  config.crossing = 3;
  write_scene(folder.path() / "data", config);
  expect_same_bytes(folder);
}

TEST(Determinism, LidarRunsGiveSameBytes) {
  const TempFolder folder;
  write_hall(folder.path() / "data", 6);
  expect_same_bytes(folder);
}

}  // namespace
}  // namespace mms
