#include "apps/mms/commands/live/ros2_map_saver.hpp"

#include <fmt/core.h>

#include <utility>

#include "mms/io/results/trajectory_io.hpp"
#include "mms/pipeline/live_map.hpp"
#include "mms/run/results/robot_maps.hpp"

namespace mms {

Ros2MapSaver::Ros2MapSaver(std::filesystem::path folder, bool is_camera)
    : folder_(std::move(folder)), frame_(is_camera ? MapFrame::kCamera : MapFrame::kLidar) {}

void Ros2MapSaver::request(const Ros2Node::Reply& reply) {
  const std::scoped_lock lock(mutex_);
  waiting_.push_back({reply, Clock::now()});
}

void Ros2MapSaver::refuse_late() {
  constexpr auto kMaxWait = std::chrono::seconds(5);
  const std::scoped_lock lock(mutex_);
  if (waiting_.empty() || Clock::now() - waiting_.front().since < kMaxWait) return;
  for (const Request& request : waiting_) {
    request.reply(
        {false,
         "no frame arrives, with which the map would be saved: call again when frames come"});
  }
  waiting_.clear();
}

void Ros2MapSaver::add(const Processed& processed, const SlamSystem& system) {
  const FrameResult& result = processed.result;
  const StampedPose pose{processed.frame.stamp, result.odometry.T_world_sensor};
  poses_.push_back({pose, result.session, result.keyframe});
  std::vector<Request> requests;
  {
    const std::scoped_lock lock(mutex_);
    requests.swap(waiting_);
  }
  if (requests.empty()) return;
  const TriggerResult answer = save(system, places_at(result));
  for (const Request& request : requests) request.reply(answer);
}

TriggerResult Ros2MapSaver::save(const SlamSystem& system,
                                 const std::vector<SessionPlace>& places) const {
  try {
    Trajectory trajectory, keyframes, corrected;
    for (const SessionPose& at : poses_) {
      trajectory.push_back(at.pose);
      if (at.keyframe) keyframes.push_back(at.pose);
      const auto T = places[at.session].corrected(at.pose.stamp, at.pose.T_world_sensor);
      if (T) corrected.push_back({at.pose.stamp, *T});
    }
    const MapCloud map = result_map(system.mapping(), frame_, places);
    std::filesystem::create_directories(folder_);
    write_result_files(folder_, trajectory, keyframes, map, frame_);
    write_trajectory_tum(folder_ / "trajectory_map.tum", corrected);
    std::string note;
    if (are_corrected(places)) {
      note = "; loops correct the map, so the occupancy maps are written at the end of the run";
    } else {
      write_robot_maps(folder_, system.occupancy_map(), map, frame_ == MapFrame::kCamera);
    }
    return {true, fmt::format("{} points, {} poses in {}{}", map.size(), poses_.size(),
                              std::filesystem::absolute(folder_).string(), note)};
  } catch (const std::exception& error) {
    return {false, error.what()};
  }
}

}  // namespace mms
