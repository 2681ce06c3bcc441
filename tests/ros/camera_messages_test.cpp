#include "mms/ros/camera_messages.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

const CameraIntrinsics kCamera{500, 510, 320, 240, 640, 480, {0.1, -0.2, 0.01, 0.02, 0.3}};

TEST(CameraMessages, RoundTrip) {
  EXPECT_EQ(intrinsics_of(camera_info_message({}, kCamera), false, "test"), kCamera);
}

TEST(CameraMessages, RectifiedImagesUseProjectionWithoutDistortion) {
  msg::CameraInfo message = camera_info_message({}, kCamera);
  message.P[0] = 490;
  message.P[6] = 241;
  const CameraIntrinsics camera = intrinsics_of(message, true, "test");
  EXPECT_EQ(camera.fx, 490);
  EXPECT_EQ(camera.cy, 241);
  EXPECT_EQ(camera.distortion, (std::array<double, 5>{}));
}

TEST(CameraMessages, RejectsUnsupportedDistortion) {
  const auto error = [](const msg::CameraInfo& message) {
    return message_of<DataError>([&] { intrinsics_of(message, false, "test"); });
  };
  msg::CameraInfo message = camera_info_message({}, kCamera);
  message.distortion_model = "equidistant";
  expect_in("has the distortion model 'equidistant' of 5 coefficients, expected plumb_bob",
            error(message));
  message.D = {0, 0, 0, 0};
  EXPECT_EQ(intrinsics_of(message, false, "test").distortion, (std::array<double, 5>{}));
  message.distortion_model = "rational_polynomial";
  message.D = {0.1, 0, 0, 0, 0.2, 0, 0, 0};
  EXPECT_EQ(intrinsics_of(message, false, "test").distortion[4], 0.2);
  message.D[5] = 0.5;
  expect_in("of 8 coefficients", error(message));
}

TEST(CameraMessages, KnowsNamesOfRealSense) {
  msg::CameraInfo message = camera_info_message({}, kCamera);
  message.distortion_model = "Brown Conrady";
  EXPECT_EQ(intrinsics_of(message, false, "test"), kCamera);
  message.distortion_model = "Inverse Brown Conrady";
  EXPECT_EQ(intrinsics_of(message, false, "test"), kCamera);
  message.distortion_model = "Kannala Brandt4";
  expect_in("has the distortion model 'Kannala Brandt4' of 5 coefficients",
            message_of<DataError>([&] { intrinsics_of(message, false, "test"); }));
}

TEST(CameraMessages, RejectsUncalibratedCameras) {
  expect_in("is not calibrated",
            message_of<DataError>([] { intrinsics_of(msg::CameraInfo(), false, "test"); }));
  msg::CameraInfo message = camera_info_message({}, kCamera);
  message.binning_x = 2;
  expect_in("binning 2x0", message_of<DataError>([&] { intrinsics_of(message, false, "test"); }));
}

TEST(CameraMessages, KnowsNamesOfRectifiedImages) {
  EXPECT_TRUE(is_named_rectified("/camera/rgb/image_rect_color/compressed"));
  EXPECT_TRUE(is_named_rectified("/zed/zed_node/rgb/color/rect/image"));
  EXPECT_FALSE(is_named_rectified("/camera/color/image_raw"));
}

}  // namespace
}  // namespace mms
