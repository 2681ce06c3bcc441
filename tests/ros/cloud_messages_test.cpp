#include "mms/ros/cloud_messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

constexpr Timestamp kStamp(1'700'000'000'500'000'000);

/// A cloud put together field by field.
class CloudBuilder {
 public:
  CloudBuilder(std::uint32_t width, std::uint32_t height, std::uint32_t point_step,
               std::uint32_t row_padding = 0, bool big_endian = false) {
    cloud_.width = width;
    cloud_.height = height;
    cloud_.point_step = point_step;
    cloud_.row_step = width * point_step + row_padding;
    cloud_.is_bigendian = big_endian;
    cloud_.data.assign(std::size_t{cloud_.row_step} * height, 0xCD);
  }

  template <class T>
  CloudBuilder& field(const std::string& name, std::uint32_t offset, std::uint8_t datatype,
                      const std::vector<T>& values) {
    cloud_.point_fields.push_back({name, offset, datatype, 1});
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint8_t* at = cloud_.data.data() + i / cloud_.width * cloud_.row_step +
                         i % cloud_.width * cloud_.point_step + offset;
      std::memcpy(at, &values[i], sizeof(T));
      if (cloud_.is_bigendian) std::reverse(at, at + sizeof(T));
    }
    return *this;
  }

  CloudBuilder& positions() {
    field<float>("x", 0, 7, {1.0F, 4.0F});
    field<float>("y", 4, 7, {2.0F, NAN});
    return field<float>("z", 8, 7, {3.0F, 6.0F});
  }

  msg::PointCloud2 cloud() const { return cloud_; }
  LidarScan scan() const { return scan_of(cloud_, kStamp, "test"); }

 private:
  msg::PointCloud2 cloud_;
};

TEST(CloudMessages, KeepsNanPoints) {
  const LidarScan scan = CloudBuilder(2, 1, 12).positions().scan();
  ASSERT_EQ(scan.points.size(), 2U);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(std::isnan(scan.points[1].y()));
  EXPECT_TRUE(scan.intensity.empty());
  EXPECT_TRUE(scan.time_offset.empty());
}

TEST(CloudMessages, ReadsAnyTypesOffsetsAndOrder) {
  const LidarScan scan = CloudBuilder(2, 1, 40)
                             .field<std::uint16_t>("ring", 1, 4, {3, 4})
                             .field<double>("z", 3, 8, {0.5, 1.5})
                             .field<std::int16_t>("x", 11, 3, {-7, 8})
                             .field<float>("y", 21, 7, {2.0F, 3.0F})
                             .field<std::uint8_t>("reflectivity", 30, 2, {200, 100})
                             .scan();
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(-7, 2, 0.5));
  EXPECT_EQ(scan.points[1], Eigen::Vector3f(8, 3, 1.5));
  EXPECT_EQ(scan.intensity, (std::vector<float>{200, 100}));
}

TEST(CloudMessages, ReadsBigEndianAndPaddedRows) {
  const LidarScan scan = CloudBuilder(1, 2, 16, 7, true)
                             .field<float>("x", 0, 7, {1.0F, 4.0F})
                             .field<float>("y", 4, 7, {2.0F, 5.0F})
                             .field<float>("z", 8, 7, {3.0F, 6.0F})
                             .field<std::uint32_t>("t", 12, 6, {0, 100'000'000})
                             .scan();
  EXPECT_EQ(scan.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_FLOAT_EQ(scan.time_offset[1], 0.1F);
}

TEST(CloudMessages, ReadsPointTimesInEveryUnit) {
  const auto seconds =
      CloudBuilder(2, 1, 16).positions().field<float>("time", 12, 7, {-0.1F, 0.0F});
  EXPECT_EQ(seconds.scan().time_offset, (std::vector<float>{-0.1F, 0.0F}));
  const auto nanoseconds =
      CloudBuilder(2, 1, 16).positions().field<std::uint32_t>("t", 12, 6, {5'000, 99'000'000});
  EXPECT_FLOAT_EQ(nanoseconds.scan().time_offset[0], 5e-6F);
  EXPECT_FLOAT_EQ(nanoseconds.scan().time_offset[1], 0.099F);
  const auto microseconds =
      CloudBuilder(2, 1, 16).positions().field<std::uint32_t>("offset_time", 12, 6, {0, 99'000});
  EXPECT_FLOAT_EQ(microseconds.scan().time_offset[1], 0.099F);
  const auto absolute = CloudBuilder(2, 1, 20).positions().field<double>(
      "timestamp", 12, 8, {1'700'000'000.5, 1'700'000'000.6});
  EXPECT_NEAR(absolute.scan().time_offset[0], 0.0, 1e-6);
  EXPECT_NEAR(absolute.scan().time_offset[1], 0.1, 1e-6);
  const auto absolute_ns = CloudBuilder(2, 1, 20).positions().field<double>(
      "timestamp", 12, 8, {1.7000000005e18, 1.7000000006e18});
  EXPECT_NEAR(absolute_ns.scan().time_offset[1], 0.1, 1e-5);
}

/// A sensor whose clock is not set counts from its start, and so does the driver that stamps by it.
TEST(CloudMessages, ReadsPointTimesSinceTheStartOfTheSensor) {
  const auto cloud =
      CloudBuilder(2, 1, 20).positions().field<double>("timestamp", 12, 8, {51.35e9, 51.45e9});
  bool other_clock = true;
  const LidarScan scan = scan_of(cloud.cloud(), Timestamp(51'350'000'000), "test", &other_clock);
  EXPECT_NEAR(scan.time_offset[0], 0.0, 1e-6);
  EXPECT_NEAR(scan.time_offset[1], 0.1, 1e-6);
  EXPECT_FALSE(other_clock);
}

TEST(CloudMessages, PointTimesOfAnotherClockBeginAtTheStamp) {
  const auto since_start =
      CloudBuilder(2, 1, 20).positions().field<double>("timestamp", 12, 8, {51.45e9, 51.35e9});
  const auto since_1970 = CloudBuilder(2, 1, 20).positions().field<double>(
      "timestamp", 12, 8, {1'600'000'000.1, 1'600'000'000.0});
  for (const auto& cloud : {since_start, since_1970}) {
    bool other_clock = false;
    const LidarScan scan = scan_of(cloud.cloud(), kStamp, "test", &other_clock);
    EXPECT_NEAR(scan.time_offset[0], 0.1, 1e-6);
    EXPECT_EQ(scan.time_offset[1], 0.0F);
    EXPECT_TRUE(other_clock);
  }
}

TEST(CloudMessages, NanTimesEqualStamp) {
  const auto some = CloudBuilder(2, 1, 16).positions().field<float>("time", 12, 7, {NAN, 0.05F});
  EXPECT_EQ(some.scan().time_offset, (std::vector<float>{0.0F, 0.05F}));
  const auto all = CloudBuilder(2, 1, 16).positions().field<float>("time", 12, 7, {NAN, NAN});
  EXPECT_TRUE(all.scan().time_offset.empty());
}

TEST(CloudMessages, ReadsRowsWithoutPoints) {
  msg::PointCloud2 empty = CloudBuilder(2, 1, 12).positions().cloud();
  empty.width = 0;
  empty.height = UINT32_MAX;
  empty.row_step = 0;
  empty.data.clear();
  EXPECT_TRUE(scan_of(empty, Timestamp(), "test").points.empty());
}

TEST(CloudMessages, ErrorsExplainProblem) {
  const auto error = [](const msg::PointCloud2& cloud) {
    return message_of<DataError>([&] { scan_of(cloud, kStamp, "test"); });
  };
  const msg::PointCloud2 valid = CloudBuilder(2, 1, 12).positions().cloud();
  msg::PointCloud2 flat = valid;
  flat.point_fields.pop_back();
  expect_in("test: has no field 'z' (it has x, y)", error(flat));
  msg::PointCloud2 few = valid;
  few.data.pop_back();
  expect_in("has 23 bytes for 2x1 points of 12", error(few));
  msg::PointCloud2 outside = valid;
  outside.point_fields[2].offset = 9;
  expect_in("its field 'z' ends at byte 13 of points with 12", error(outside));
  msg::PointCloud2 wrapped = valid;
  wrapped.point_fields[2].offset = 0xFFFFFFFE;
  expect_in("its field 'z' ends at byte 4294967298", error(wrapped));
  msg::PointCloud2 unknown = valid;
  unknown.point_fields[0].datatype = 9;
  expect_in("its field 'x' has the unknown type 9", error(unknown));
  msg::PointCloud2 overlapping = CloudBuilder(1, 2, 12).positions().cloud();
  overlapping.row_step = 4;
  expect_in("has 24 bytes for 1x2 points", error(overlapping));
}

TEST(CloudMessages, RoundTrip) {
  LidarScan scan;
  scan.points = {{1, 2, 3}, {4, 5, 6}};
  scan.intensity = {0.5F, 0.25F};
  scan.time_offset = {0.0F, 0.05F};
  const LidarScan back = scan_of(cloud_message({}, scan), kStamp, "test");
  EXPECT_EQ(back.points, scan.points);
  EXPECT_EQ(back.intensity, scan.intensity);
  EXPECT_EQ(back.time_offset, scan.time_offset);
  EXPECT_TRUE(scan_of(cloud_message({}, {}), kStamp, "test").points.empty());
}

}  // namespace
}  // namespace mms
