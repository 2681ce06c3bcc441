#include "mms/dataset/live/frame_assembler.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests
using Sensor = FrameAssembler::Sensor;

constexpr int kWidth = 4;
constexpr int kHeight = 3;
const CameraIntrinsics kCamera{10, 10, 2, 1, kWidth, kHeight, {}};

Timestamp at(int milliseconds) {
  return Timestamp(1'000'000 * std::int64_t{milliseconds});
}

/// A FrameAssembler with stamps in milliseconds.
class Assembly {
 public:
  explicit Assembly(Sensor sensor) : assembler(sensor) {
    if (sensor != Sensor::kCloud) assembler.set_camera(kCamera);
  }

  void color(int t) { assembler.add_color(at(t), Image<Rgb>(kWidth, kHeight)); }
  void depth(int t) {
    assembler.add_depth(at(t), Image<float>(kWidth, kHeight, static_cast<float>(t)));
  }
  void cloud(int t) {
    LidarScan scan;
    scan.points.emplace_back(1.0F, 2.0F, 3.0F);
    assembler.add_cloud(at(t), scan);
  }

  /// "100+5": stamp and depth offset of all available frames.
  std::string frames() {
    std::string text;
    while (const auto frame = assembler.next()) {
      const auto ms = [](std::int64_t ns) { return std::to_string(ns / 1'000'000); };
      text += (text.empty() ? "" : " ") + ms(frame->stamp.nanoseconds());
      if (frame->has_depth()) text += "+" + ms(frame->depth_offset.count());
      if (!frame->scan.points.empty()) text += frame->color.empty() ? "alone" : "with image";
    }
    return text;
  }

  FrameAssembler assembler;
};

TEST(FrameAssembler, GoesOnWhereTheClockGoesBack) {
  Assembly a(Sensor::kDepth);
  a.color(5000);
  a.depth(5000);
  a.color(5100);  // its depth image never comes
  EXPECT_EQ(a.frames(), "5000+0");
  a.depth(4500);  // late, but of the same clock
  a.color(100);
  a.depth(100);
  EXPECT_EQ(a.frames(), "100+0");
  a.color(200);
  a.depth(200);
  EXPECT_EQ(a.frames(), "200+0");
}

TEST(FrameAssembler, ReportsClocksThatDiffer) {
  Assembly a(Sensor::kDepth);
  for (int t = 20000; t < 21000; t += 100) {
    a.color(t);
    a.depth(t + 10000);
    EXPECT_EQ(a.frames(), "");
  }
  expect_in("no two within 0.02 s, the last ones are 9.100 s apart", a.assembler.report(1.0));
}

TEST(FrameAssembler, PairsImagesInAnyOrder) {
  Assembly a(Sensor::kDepth);
  a.color(100);
  EXPECT_EQ(a.frames(), "");
  a.depth(100);
  EXPECT_EQ(a.frames(), "100+0");
  a.depth(203);
  a.color(200);
  EXPECT_EQ(a.frames(), "200+3");
}

TEST(FrameAssembler, WaitsForNearestStamp) {
  Assembly a(Sensor::kDepth);
  a.color(100);
  a.depth(88);
  EXPECT_EQ(a.frames(), "") << "a later image may be nearer";
  a.depth(107);
  EXPECT_EQ(a.frames(), "100+7");
}

TEST(FrameAssembler, DropsUnmatchedImages) {
  Assembly a(Sensor::kDepth);
  a.color(100);
  a.color(200);
  a.depth(200);
  EXPECT_EQ(a.frames(), "200+0");
  EXPECT_EQ(a.assembler.unmatched(), 1U);
}

TEST(FrameAssembler, UsesImagesOnce) {
  Assembly a(Sensor::kDepth);
  a.depth(100);
  a.color(98);
  a.color(102);
  a.depth(140);
  EXPECT_EQ(a.frames(), "98+2");
  EXPECT_EQ(a.assembler.unmatched(), 1U);
}

TEST(FrameAssembler, IgnoresDecreasingStamps) {
  Assembly a(Sensor::kDepth);
  a.color(100);
  a.color(100);
  a.color(90);
  a.depth(100);
  EXPECT_EQ(a.frames(), "100+0");
}

TEST(FrameAssembler, AssemblesCloudsWithAndWithoutImages) {
  Assembly cloud_only(Sensor::kCloud);
  cloud_only.cloud(100);
  EXPECT_EQ(cloud_only.frames(), "100alone");
  Assembly with_camera(Sensor::kCloudWithCamera);
  with_camera.assembler.set_extrinsics({});
  with_camera.cloud(100);
  EXPECT_EQ(with_camera.frames(), "") << "its image may follow";
  with_camera.color(130);
  EXPECT_EQ(with_camera.frames(), "100with image");
  for (const int t : {200, 300, 400}) with_camera.cloud(t);
  EXPECT_EQ(with_camera.frames(), "200alone") << "a camera that fails does not stop the LiDAR";
}

TEST(FrameAssembler, TellsStampOfColorImage) {
  Assembly images(Sensor::kDepth);
  EXPECT_FALSE(images.assembler.color_stamp());
  images.color(100);
  images.depth(107);
  ASSERT_TRUE(images.assembler.next());
  EXPECT_EQ(images.assembler.color_stamp(), at(100));
  Assembly clouds(Sensor::kCloudWithCamera);
  clouds.assembler.set_extrinsics({});
  clouds.cloud(100);
  clouds.color(130);
  ASSERT_TRUE(clouds.assembler.next());
  EXPECT_EQ(clouds.assembler.color_stamp(), at(130));
  for (const int t : {200, 300, 400}) clouds.cloud(t);
  ASSERT_TRUE(clouds.assembler.next());  // without an image
  EXPECT_FALSE(clouds.assembler.color_stamp());
}

TEST(FrameAssembler, CloudsWithImagesWaitForExtrinsics) {
  Assembly a(Sensor::kCloudWithCamera);
  for (const int t : {100, 200, 300, 400}) {
    a.cloud(t);
    a.color(t);
  }
  EXPECT_EQ(a.frames(), "");
  expect_in("no transform from the cloud's frame to the camera's", a.assembler.report(1.0));
  a.assembler.set_extrinsics({});
  EXPECT_EQ(a.frames(), "100with image 200with image 300with image 400with image");
}

TEST(FrameAssembler, RejectsUnregisteredDepth) {
  Assembly a(Sensor::kDepth);
  a.color(100);
  a.assembler.add_depth(at(100), Image<float>(8, 8));
  expect_in("depth image: is 8x8 pixels, the camera_info says 4x3",
            message_of<DataError>([&] { a.assembler.next(); }));
  a.color(200);
  a.depth(200);
  EXPECT_EQ(a.frames(), "200+0") << "it continues with the next one";
}

TEST(FrameAssembler, ReportsMissingInputs) {
  FrameAssembler none(Sensor::kDepth);
  EXPECT_EQ(none.report(1.0),
            "color images: none received; camera_info: none received; depth images: none received");
  Assembly unmatched(Sensor::kDepth);
  for (int t = 0; t < 1000; t += 100) {
    unmatched.color(t);
    unmatched.depth(t + 350);
  }
  EXPECT_EQ(unmatched.frames().find("0+"), std::string::npos);
  expect_in("color images: 5.0 per second", unmatched.assembler.report(2.0));
  EXPECT_EQ(FrameAssembler(Sensor::kCloud).report(1.0), "clouds: none received");
}

}  // namespace
}  // namespace mms
