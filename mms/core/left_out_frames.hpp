#pragma once

#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "mms/core/frame.hpp"

namespace mms {

/// What frames that are left out hand on to the next one that is kept: their motion samples, since
/// those of a run have no holes, and the place that a user has given, since it is given once.
class LeftOutFrames {
 public:
  /// Keeps a copy of what a frame hands on.
  void add(const Frame& left_out) {
    append(motion_.wheels, left_out.motion.wheels);
    append(motion_.imu, left_out.motion.imu);
    forget_old(motion_.wheels);
    forget_old(motion_.imu);
    if (left_out.expected_place) expected_place_ = left_out.expected_place;
  }

  /// Gives all to the next frame: the samples in front of its own, the place if it has none.
  void give_to(Frame& next) {
    prepend(std::exchange(motion_.wheels, {}), next.motion.wheels);
    prepend(std::exchange(motion_.imu, {}), next.motion.imu);
    const auto place = std::exchange(expected_place_, std::nullopt);
    if (!next.expected_place) next.expected_place = place;
  }

 private:
  /// [s]: age of the samples that are kept. Source: the odometry forgets older ones, too; a sensor
  /// whose frames are left out for hours must not fill the memory.
  static constexpr Duration kMaxAge = std::chrono::seconds(60);

  template <class Sample>
  static void forget_old(std::vector<Sample>& samples) {
    if (samples.empty()) return;
    const Timestamp last = samples.back().stamp;
    std::erase_if(samples, [&](const Sample& sample) { return last - sample.stamp > kMaxAge; });
  }

  template <class Sample>
  static void append(std::vector<Sample>& all, const std::vector<Sample>& more) {
    all.insert(all.end(), more.begin(), more.end());
  }

  template <class Sample>
  static void prepend(std::vector<Sample> earlier, std::vector<Sample>& samples) {
    if (earlier.empty()) return;
    append(earlier, samples);
    samples = std::move(earlier);
  }

  MotionSamples motion_;
  std::optional<Transform<Global, Sensor>> expected_place_;
};

}  // namespace mms
