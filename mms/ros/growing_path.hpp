#pragma once

#include <cstddef>

#include "mms/ros/display_messages.hpp"

namespace mms {

/// The path of a sensor that may run for days, as a message of bounded size: the poses are thinned
/// evenly, and the last one is always the latest.
class GrowingPath {
 public:
  /// [-]: largest number of poses. Source: a message of 1 MB, which is sent twice a second; the
  /// first 5 minutes of a 30 Hz camera are kept pose by pose.
  static constexpr std::size_t kMaxPoses = 10'000;

  /// Adds the pose of the next frame.
  /// @param header  of the frame; that of the message, too
  void add(const msg::Header& header, const msg::Pose& pose);

  /// The path so far.
  const msg::Path& message() const { return path_; }

 private:
  void halve();

  msg::Path path_;
  std::size_t added_ = 0;
  std::size_t stride_ = 1;  // of the poses that stay
};

}  // namespace mms
