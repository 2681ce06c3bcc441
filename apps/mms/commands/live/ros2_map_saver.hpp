#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <vector>

#include "mms/core/trajectory.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/session_places.hpp"
#include "mms/ros2/ros2_node.hpp"
#include "mms/run/results/result_files.hpp"

namespace mms {

/// Answers the service ~/save_map with the next frame: the maps belong to the thread of the run.
class Ros2MapSaver {
 public:
  /// @param folder  of the files
  Ros2MapSaver(std::filesystem::path folder, bool is_camera);

  // In the node's thread:

  void request(const Ros2Node::Reply& reply);
  /// Refuses requests where no frame comes.
  void refuse_late();

  /// Takes a frame's pose, and answers requests. In the thread of the run.
  void add(const Processed& processed, const SlamSystem& system);

 private:
  using Clock = std::chrono::steady_clock;
  struct Request {
    Ros2Node::Reply reply;
    Clock::time_point since;
  };
  struct SessionPose {
    StampedPose pose;
    std::uint32_t session = 0;
    bool keyframe = false;
  };

  TriggerResult save(const SlamSystem& system, const std::vector<SessionPlace>& places) const;

  std::filesystem::path folder_;
  MapFrame frame_;
  std::vector<SessionPose> poses_;  // of the thread of the run
  std::mutex mutex_;                ///< guards all below
  std::vector<Request> waiting_;
};

}  // namespace mms
