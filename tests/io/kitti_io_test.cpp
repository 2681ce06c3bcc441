#include "mms/io/cloud/kitti_io.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

/// The numbers of a file.
std::vector<float> floats_in(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

TEST(KittiIo, WritesPointsAndReflectance) {
  const TempFolder folder;
  LidarScan scan;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  scan.points = {{1.0F, -2.0F, 0.1F}, {kNan, kNan, kNan}};
  scan.intensity = {0.5F, 0.0F};
  write_kitti_scan(folder.path() / "a.bin", scan);
  const std::vector<float> numbers = floats_in(folder.path() / "a.bin");
  ASSERT_EQ(numbers.size(), 8U);
  EXPECT_EQ(std::vector<float>(numbers.begin(), numbers.begin() + 4),
            (std::vector<float>{1.0F, -2.0F, 0.1F, 0.5F}));
  EXPECT_TRUE(std::isnan(numbers[4]));
}

TEST(KittiIo, ReflectanceIsZeroWithoutIntensity) {
  const TempFolder folder;
  LidarScan scan;
  scan.points = {{1.0F, 2.0F, 3.0F}};
  write_kitti_scan(folder.path() / "a.bin", scan);
  EXPECT_EQ(floats_in(folder.path() / "a.bin"), (std::vector<float>{1.0F, 2.0F, 3.0F, 0.0F}));
  scan.intensity = {1.0F, 2.0F};
  expect_in("has 1 points and 2 intensities",
            message_of<DataError>([&] { write_kitti_scan(folder.path() / "a.bin", scan); }));
}

TEST(KittiIo, PointTimesRoundTrip) {
  const TempFolder folder;
  const std::vector<float> times = {0.0F, 0.001F, 0.1F};
  write_point_times(folder.path() / "a.bin", times);
  EXPECT_EQ(read_point_times(folder.path() / "a.bin"), times);
  expect_in("has 5 bytes, not a multiple of 4",
            message_of<DataError>([&] { read_point_times(folder.write("b.bin", "12345")); }));
  write_point_times(folder.path() / "a.bin", {0.0F, std::numeric_limits<float>::infinity()});
  expect_in("the time of point 1 is not finite",
            message_of<DataError>([&] { read_point_times(folder.path() / "a.bin"); }));
}

}  // namespace
}  // namespace mms
