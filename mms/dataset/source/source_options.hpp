#pragma once

#include <filesystem>
#include <optional>

#include "mms/dataset/source/bag_topic_names.hpp"
#include "mms/dataset/source/camera_options.hpp"
#include "mms/dataset/source/motion_files.hpp"

namespace mms {

/// Options for opening a recording.
struct SourceOptions {
  std::filesystem::path masks{};  ///< folder of label images that replaces the recording's masks/
  bool load_masks = true;         ///< false: frames come without masks
  bool map_truth = true;          ///< false: a simulation does not keep FrameSource::map_truth and
                                  ///< objects_truth, which grow with its frames
  BagTopicNames topics{};         ///< of a bag
  CameraOptions camera{};         ///< in place of the recording's
  std::optional<double> rate{};   ///< [Hz] of a recording without time stamps; unset: assumed
  MotionOptions motion{};         ///< of wheels and gyroscope
};

}  // namespace mms
