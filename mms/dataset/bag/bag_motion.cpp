#include "mms/dataset/bag/bag_motion.hpp"

#include "mms/core/error.hpp"
#include "mms/ros/motion_messages.hpp"

namespace mms {
namespace {

bool is_finite(const WheelSample& sample) {
  return sample.T_odom_base.is_finite();
}

bool is_finite(const ImuSample& sample) {
  return sample.rate.allFinite();
}

template <class Message, class Sample>
void read_samples(const BagReader& bag, const std::string& topic, std::vector<Sample>& samples,
                  std::vector<std::string>& warnings) {
  std::size_t not_later = 0;
  std::size_t not_finite = 0;
  for (std::size_t i = 0; i < bag.count(topic); ++i) {
    try {
      Sample sample = sample_of(bag.read<Message>(topic, i));
      if (!is_finite(sample)) {
        ++not_finite;
      } else if (!samples.empty() && sample.stamp <= samples.back().stamp) {
        ++not_later;
      } else {
        samples.push_back(std::move(sample));
      }
    } catch (const DataError& error) {
      warnings.emplace_back(error.what());
    }
  }
  const auto report = [&](std::size_t count, const char* what) {
    if (count > 0) warnings.push_back(topic + ": " + std::to_string(count) + " messages " + what);
  };
  report(not_later, "left out whose stamps are not later than the ones before");
  report(not_finite, "left out whose numbers are not finite");
}

}  // namespace

MotionRecording read_bag_motion(const BagReader& bag, const BagTopicNames& topics,
                                const MotionOptions& options, std::vector<std::string>& warnings) {
  MotionRecording recording;
  if (!topics.wheels.empty() && options.wheels.empty()) {
    read_samples<msg::Odometry>(bag, topics.wheels, recording.samples.wheels, warnings);
  }
  if (!topics.imu.empty() && options.imu.empty()) {
    read_samples<msg::Imu>(bag, topics.imu, recording.samples.imu, warnings);
  }
  describe_motion(recording, topics.wheels, topics.imu);
  return recording;
}

}  // namespace mms
