#include "mms/dataset/lidar/scan_format.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

TEST(ScanFormat, ReadsPointsAndKeepsNaN) {
  const TempFolder folder;
  const float values[] = {1.0F, 2.0F, 3.0F, 0.5F, std::nanf(""), 0.0F, 0.0F, 0.25F};
  std::string bytes(sizeof values, '\0');
  std::memcpy(bytes.data(), values, sizeof values);
  const LidarScan scan = read_scan(folder.write("a.bin", bytes), {});
  ASSERT_EQ(scan.points.size(), 2U);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(std::isnan(scan.points[1].x()));
  EXPECT_EQ(scan.intensity, (std::vector<float>{0.5F, 0.25F}));
  EXPECT_TRUE(scan.time_offset.empty());
}

TEST(ScanFormat, RejectsInvalidSizes) {
  const TempFolder folder;
  const auto error = [&](const std::string& bytes, const ScanFormat& format) {
    return message_of<DataError>([&] { read_scan(folder.write("a.bin", bytes), format); });
  };
  expect_in("is empty", error("", {}));
  expect_in("has 33 bytes, not a multiple of 16", error(std::string(33, 'x'), {}));
  expect_in("has 15 bytes, not a multiple of 8 (a point has 8 bytes; the scan may be truncated)",
            error(std::string(15, 'x'), {.kind = ScanFormat::Kind::kNclt}));
}

}  // namespace
}  // namespace mms
