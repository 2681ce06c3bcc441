#include "mms/localization/robot_body/robot_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mms/geometry/camera.hpp"
#include "mms/localization/features/feature_extractor.hpp"
#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

using testing::BoxRoom;
using testing::motion;
using testing::position_error;

constexpr int kInterval = 33;      // between two frames [ms]
constexpr int kTopOfPlate = 84;    // row; the plate covers the rows from there on
constexpr float kPlate = 0.45F;    // its depth [m]
constexpr double kShare = 0.3;     // of the image that it covers
constexpr int kFramesToFind = 60;  // at 0.3 m/s

/// At rest for half a second, then through the room.
Eigen::Isometry3d truth_at(Timestamp stamp) {
  const double t = std::max(0.0, stamp.seconds() - 0.5);
  return motion(0.15 * t, -0.02 * t, 0.3 * t, 0.02 * t, 0.1 * t, 0.0);
}

/// A checkered plate before the camera, fixed to it.
void add_plate(LabeledCloud& cloud) {
  const CameraModel camera(cloud.camera);
  for (int y = kTopOfPlate; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      const Eigen::Vector3f ray = camera.ray({x, y}).cast<float>();
      cloud.points[i] = (kPlate + 0.003F * static_cast<float>(cloud.height - y)) * ray;
      const auto grey = static_cast<std::uint8_t>((x / 7 + y / 5) % 2 == 0 ? 60 : 180);
      cloud.colors[i] = {grey, grey, grey};
    }
  }
}

LabeledCloud view(int frame, bool has_plate) {
  const Timestamp stamp(std::int64_t{frame} * kInterval * 1'000'000);
  LabeledCloud cloud =
      testing::organised_cloud(BoxRoom{}, truth_at(stamp), 1.0, static_cast<unsigned>(frame));
  cloud.stamp = stamp;
  if (has_plate) add_plate(cloud);
  return cloud;
}

/// Odometry that looks for parts of the robot, as the stage of the pipeline does.
class Camera {
 public:
  explicit Camera(bool searches) : body_({.enabled = searches}, {}) {}

  void add(LabeledCloud cloud) {
    FeatureCloud features = extractor_.extract(cloud);
    body_.exclude(cloud, features);
    const auto seen = body_.see(cloud, features);
    OdometryEstimate estimate = odometry_.estimate(std::move(features));
    RobotBody::Found found = body_.search(seen, odometry_, estimate);
    found_ += found.is_new;
    if (found.correction) {
      odometry_ = std::move(found.correction->odometry);
      estimate = found.correction->estimate;
    }
    error_ = position_error(estimate.T_world_sensor.isometry(), truth_at(cloud.stamp));
    const auto valid = std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kStatic);
    valid_share_ = static_cast<double>(valid) / static_cast<double>(cloud.labels.size());
  }

  double error() const { return error_; }              ///< of the last position [m]
  double valid_share() const { return valid_share_; }  ///< of the last frame's points
  int found() const { return found_; }                 ///< parts
  double share() const { return body_.share(); }

 private:
  FeatureExtractor extractor_{FeatureConfig{}};
  Odometry odometry_{OdometryConfig{}, {}};
  RobotBody body_;
  double error_ = 0.0;
  double valid_share_ = 1.0;
  int found_ = 0;
};

Camera drive(bool has_plate, bool searches) {
  Camera camera(searches);
  for (int frame = 0; frame < kFramesToFind; ++frame) camera.add(view(frame, has_plate));
  return camera;
}

TEST(RobotBody, HoldsThePoseIfItIsNotIgnored) {
  EXPECT_GT(drive(true, false).error(), 0.3);
}

TEST(RobotBody, IsFoundAndDoesNotHoldThePose) {
  const Camera camera = drive(true, true);
  EXPECT_GE(camera.found(), 1);
  EXPECT_LT(camera.error(), 0.02);
  EXPECT_NEAR(camera.share(), kShare, 0.05);
  EXPECT_NEAR(camera.valid_share(), 1.0 - kShare, 0.05) << "all its points are invalid";
}

TEST(RobotBody, IsNotFoundInARoomWithNearWalls) {
  const Camera camera = drive(false, true);
  EXPECT_EQ(camera.found(), 0);
  EXPECT_EQ(camera.error(), drive(false, false).error());
  EXPECT_EQ(camera.valid_share(), 1.0);
}

TEST(RobotBody, IsForgottenOnceItIsGone) {
  Camera camera = drive(true, true);
  for (int frame = kFramesToFind; frame < kFramesToFind + 10; ++frame) {
    camera.add(view(frame, false));
  }
  EXPECT_EQ(camera.share(), 0.0);
  EXPECT_EQ(camera.valid_share(), 1.0);
  EXPECT_LT(camera.error(), 0.02);
}

TEST(RobotBody, IsNotIgnoredWhereTheReferenceShowsLittleElse) {
  constexpr int kLowestRow = 74;  // above it there are no returns at first
  constexpr int kFrames = 25;
  Camera camera(true);
  for (int frame = 0; frame < kFrames; ++frame) {
    LabeledCloud cloud = view(frame, true);
    for (int i = 0; frame < kFrames / 2 + 5 && i < kLowestRow * cloud.width; ++i) {
      cloud.points[static_cast<std::size_t>(i)].setConstant(std::nanf(""));
      cloud.labels[static_cast<std::size_t>(i)] = PointLabel::kInvalid;
    }
    camera.add(std::move(cloud));
  }
  EXPECT_EQ(camera.found(), 0);
}

/// What masks cover is not constant: it was not compared.
TEST(RobotBody, IsNotWhatMasksCoverBetweenTwoFrames) {
  const auto found_with = [](bool has_masks) {
    constexpr int kSecondFrame = 40;  // the camera has moved by 0.28 m then
    Camera camera(true);
    for (int frame = 0; frame <= kSecondFrame; ++frame) {
      LabeledCloud cloud = view(frame, true);
      const auto plate = static_cast<std::ptrdiff_t>(kTopOfPlate) * cloud.width;
      if (has_masks && frame != 0 && frame != kSecondFrame) {
        std::fill(cloud.labels.begin() + plate, cloud.labels.end(), PointLabel::kDynamic);
      }
      camera.add(std::move(cloud));
    }
    return camera.found();
  };
  EXPECT_GE(found_with(false), 1);
  EXPECT_EQ(found_with(true), 0);
}

TEST(RobotBody, IsNotSearchedForInScans) {
  const RobotBody body(RobotBodyConfig{}, {});
  LabeledCloud scan = testing::spinning_scan(BoxRoom{}, truth_at(Timestamp()), 16, 0.01, 1);
  EXPECT_FALSE(body.see(scan, {}));
}

}  // namespace
}  // namespace mms
