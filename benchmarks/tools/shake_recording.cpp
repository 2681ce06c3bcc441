// Makes a shaken variant of a recording of a depth camera with true poses: the camera rolls up to
// 45 degrees, images are blurred along the true optical flow, and some seconds are underexposed.
// usage: mms_shake_recording RECORDING FOLDER SWING
//   SWING  duration of one roll to both sides [s]; at 30 Hz, 2.5 s are up to 3.8 degrees a frame
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/geometry/camera.hpp"

namespace mms {
namespace {

/// [deg]: largest roll.
constexpr double kRoll = 45.0;
/// [s]: time for which the shutter is open.
constexpr double kExposure = 0.025;
/// [-]: positions of the shutter that are averaged.
constexpr int kBlurSteps = 9;
/// [-]: brightness of underexposed images, in the last of every three seconds.
constexpr double kDark = 0.3;

Eigen::Isometry3d roll(double angle) {
  return Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

/// Index of the true pose nearest to a stamp.
std::size_t nearest(const Trajectory& truth, Timestamp stamp) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const auto difference = [&](std::size_t k) {
      return std::abs(to_seconds(truth[k].stamp - stamp));
    };
    if (difference(i) < difference(best)) best = i;
  }
  return best;
}

class Shaker {
 public:
  Shaker(const CameraIntrinsics& camera, const Trajectory& truth, Timestamp begin, double swing)
      : model_(camera), truth_(truth), begin_(begin), swing_(swing) {}

  /// Pose of the rolling camera.
  Eigen::Isometry3d pose(Timestamp stamp) const {
    return truth_[nearest(truth_, stamp)].T_world_sensor.isometry() * roll(angle(stamp));
  }

  Frame shaken(const Frame& frame) const {
    Frame result = rolled(frame);
    result.color = blurred(result);
    const double seconds = to_seconds(frame.stamp - begin_);
    if (std::fmod(seconds, 3.0) > 2.0) darken(result.color);
    return result;
  }

 private:
  double angle(Timestamp stamp) const {
    const double turns = to_seconds(stamp - begin_) / swing_;
    return kRoll * std::numbers::pi / 180.0 * std::sin(2.0 * std::numbers::pi * turns);
  }

  Frame rolled(const Frame& frame) const {
    Frame result = frame;
    const Eigen::Matrix3d R = roll(angle(frame.stamp)).linear();
    for (int y = 0; y < frame.color.height(); ++y) {
      for (int x = 0; x < frame.color.width(); ++x) {
        const Eigen::Vector2d from = model_.project(R * model_.ray({x, y}));
        const auto u = static_cast<int>(std::lround(from.x()));
        const auto v = static_cast<int>(std::lround(from.y()));
        const bool inside = frame.color.contains(u, v);
        result.color(x, y) = inside ? frame.color(u, v) : Rgb{};
        result.depth(x, y) = inside ? frame.depth(u, v) : 0.0F;
        if (!frame.mask.empty()) result.mask(x, y) = inside ? frame.mask(u, v) : std::uint8_t{0};
      }
    }
    return result;
  }

  /// Mean of the pixels along each pixel's motion while the shutter is open.
  Image<Rgb> blurred(const Frame& frame) const {
    const auto half = Duration(static_cast<std::int64_t>(0.5e9 * kExposure));
    const Eigen::Isometry3d motion =
        pose(frame.stamp + half).inverse() * pose(frame.stamp + Duration(-half.count()));
    Image<Rgb> result = frame.color;
    for (int y = 0; y < result.height(); ++y) {
      for (int x = 0; x < result.width(); ++x) {
        const float depth = frame.depth(x, y) > 0.0F ? frame.depth(x, y) : kFar;
        const Eigen::Vector3d point = model_.ray({x, y}) * depth;
        const Eigen::Vector3d moved = motion * point;
        if (!(moved.z() > 0.0)) continue;
        result(x, y) = mean_along(frame.color, x, y, model_.project(moved) - Eigen::Vector2d(x, y));
      }
    }
    return result;
  }

  static Rgb mean_along(const Image<Rgb>& image, int x, int y, const Eigen::Vector2d& flow) {
    int sum[3] = {0, 0, 0};
    for (int i = 0; i < kBlurSteps; ++i) {
      const Eigen::Vector2d at = (static_cast<double>(i) / (kBlurSteps - 1) - 0.5) * flow;
      const int u = std::clamp(x + static_cast<int>(std::lround(at.x())), 0, image.width() - 1);
      const int v = std::clamp(y + static_cast<int>(std::lround(at.y())), 0, image.height() - 1);
      const Rgb& color = image(u, v);
      sum[0] += color.r;
      sum[1] += color.g;
      sum[2] += color.b;
    }
    const auto mean = [](int total) { return static_cast<std::uint8_t>(total / kBlurSteps); };
    return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
  }

  static void darken(Image<Rgb>& image) {
    for (Rgb& color : image.pixels()) {
      color = {static_cast<std::uint8_t>(kDark * color.r),
               static_cast<std::uint8_t>(kDark * color.g),
               static_cast<std::uint8_t>(kDark * color.b)};
    }
  }

  static constexpr float kFar = 5.0F;  ///< [m]: depth of pixels without a return

  CameraModel model_;
  const Trajectory& truth_;
  Timestamp begin_;
  double swing_;  ///< [s]
};

void shake(const char* recording, const char* folder, double swing) {
  const auto source = open_dataset(recording);
  const auto recorder = record_folder(folder);
  const Trajectory& truth = source->ground_truth();
  if (truth.empty()) throw std::runtime_error("a recording without true poses cannot be shaken");
  std::optional<Shaker> shaker;
  Trajectory poses;
  while (const std::optional<Frame> frame = source->next()) {
    if (!shaker) shaker.emplace(*frame->calibration->camera, truth, frame->stamp, swing);
    recorder->add(shaker->shaken(*frame));
    poses.push_back({frame->stamp, Transform<World, Sensor>(shaker->pose(frame->stamp))});
  }
  recorder->finish(poses);
}

}  // namespace
}  // namespace mms

int main(int argc, char** argv) {
  if (argc != 4) {
    std::cerr << "usage: mms_shake_recording RECORDING FOLDER SWING\n";
    return 2;
  }
  try {
    mms::shake(argv[1], argv[2], std::stod(argv[3]));
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
