#include "mms/run/view/live_view.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/mapping/ground/floor.hpp"
#include "mms/pipeline/live_map.hpp"
#include "mms/run/record/run_record.hpp"
#include "mms/run/view/frame_correction.hpp"
#include "mms/run/view/recorded_scene.hpp"
#include "mms/run/view/run_series.hpp"

namespace mms {
namespace {

/// Unique on this machine.
std::string run_id() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return fmt::format("{}-{}", ::getpid(),
                     std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

SceneInfo info_of(const std::string& data, const FrameSource& source, const SystemConfig& config,
                  std::size_t frames, bool has_truth) {
  SceneInfo info;
  info.name = std::filesystem::path(data).lexically_normal().filename().string();
  if (info.name.empty()) info.name = data;
  info.data = data;
  info.id = run_id();
  info.live = true;
  if (frames != FrameSource::kEndless) info.frames = frames;
  info.has_truth = has_truth;
  info.voxel_size = config.static_map.voxel_size;
  info.series = run_series(has_truth);
  const auto calibration = source.calibration();
  if (calibration) info.camera = calibration->camera;
  return info;
}

std::vector<float> series_of(const Processed& processed, double interval_ms,
                             const SceneFrame& frame, bool has_truth) {
  const FrameResult& result = processed.result;
  std::vector<float> values = {static_cast<float>(processed.read_ms)};
  for (const double ms : result.stage_ms) values.push_back(static_cast<float>(ms));
  values.push_back(static_cast<float>(interval_ms));
  values.push_back(static_cast<float>(result.dynamic_share));
  values.push_back(static_cast<float>(result.overruled_share));
  values.push_back(static_cast<float>(result.objects.size()));
  append_distances(values, frame, has_truth);
  return values;
}

std::vector<ObjectBox> objects_of(const FrameResult& result, Timestamp stamp) {
  std::vector<ObjectBox> boxes;
  for (const TrackedObject& object : result.objects) {
    boxes.push_back(object.box);
    boxes.back().visible = object.last_seen == stamp ? 1.0 : 0.0;
  }
  return boxes;
}

/// A change of what is displayed. If the frames cannot be read from disk, it stays as it is.
template <class Change>
void while_readable(const Change& change) {
  try {
    change();
  } catch (const FileError&) {
  }
}

/// The distances to the start and to the ground truth, which are the last series.
constexpr std::size_t kDistanceSeries = 2;

/// [s]: least time between two corrections of what is displayed.
constexpr std::chrono::seconds kCorrectionInterval{5};

/// [-]: least time between two corrections, in units of the time that the first one took. A long
/// run has many frames to move.
constexpr int kCorrectionPause = 50;

}  // namespace

LiveView::LiveView(const ViewOptions& options, const std::string& data, const FrameSource& source,
                   const SystemConfig& config, std::size_t frames)
    : truth_(source.ground_truth()),
      scene_(std::make_shared<Scene>(info_of(data, source, config, frames, !truth_.empty()),
                                     config.static_map.min_observations)),
      server_(serve(options, scene_, "--view PORT", true)) {}

void LiveView::show(Processed processed, double interval_ms, std::shared_ptr<const MapChanges> map,
                    const Mapping& mapping) {
  FrameResult& result = processed.result;
  SceneFrame frame;
  frame.stamp = processed.frame.stamp;
  frame.T_world_sensor = result.odometry.T_world_sensor;
  frame.status = result.odometry.status;
  frame.truth = truth_.at({frame.stamp, frame.T_world_sensor});
  frame.series = series_of(processed, interval_ms, frame, !truth_.empty());
  frame.objects = objects_of(result, frame.stamp);
  if (sessions_.empty()) {
    const bool depth_camera = result.cloud.organised();
    scene_->set_sensor(processed.frame.calibration->camera,
                       (depth_camera ? SensorAxes::camera() : SensorAxes::lidar()).up);
  }
  auto view = std::make_shared<const SensorView>(
      SensorView{sessions_.size(), std::move(processed.frame.color), std::move(result.cloud)});
  sessions_.push_back(result.session);
  scene_->add(std::move(frame), std::move(view), std::move(map));
  // It takes as long as several frames, and is done only for somebody.
  if (server_->viewers() == 0 || result.correction.loops == shown_.loops ||
      Clock::now() < next_correction_) {
    return;
  }
  while_readable([&] { show_corrected(result, mapping); });
}

void LiveView::show_corrected(const FrameResult& result, const Mapping& mapping) {
  const Clock::time_point begin = Clock::now();
  const MapCloud map = live_map(mapping, result);
  if (result.correction.loops) {
    scene_->set_loops(loops_between(scene_->stamps(), *result.correction.loops));
  }
  std::optional<Eigen::Isometry3d> T_truth;  // motion of the first frame with ground truth
  scene_->change(
      [&](std::size_t index, SceneFrame& frame) {
        const Eigen::Isometry3d before = frame.T_world_sensor.isometry();
        correct_frame(frame, sessions_[index], index < corrected_ ? &shown_ : nullptr,
                      result.correction);
        if (!frame.truth) return;
        if (!T_truth) T_truth = frame.T_world_sensor.isometry() * before.inverse();
        frame.truth = *T_truth * *frame.truth;
        frame.series.resize(frame.series.size() - kDistanceSeries);
        append_distances(frame.series, frame, true);
      },
      std::make_shared<const MapChanges>(
          changes_of(map.points, map.colors, mapping.static_map().voxel_size())));
  if (T_truth) truth_.move(*T_truth);
  corrected_ = sessions_.size();
  shown_ = result.correction;
  const Clock::time_point end = Clock::now();
  next_correction_ =
      end + std::max<Clock::duration>(kCorrectionInterval, kCorrectionPause * (end - begin));
}

void LiveView::end(const std::filesystem::path& folder, const RunLog& log) {
  while_readable([&] {
    are_corrected(log.places()) ? show_final_results(folder, *scene_) : show_aligned_truth(log);
  });
  scene_->end(folder);
}

void LiveView::show_aligned_truth(const RunLog& log) {
  const Trajectory truth = aligned_truth(log.truth(), log.trajectory());
  if (truth.empty()) return;
  auto next = truth.begin();
  scene_->change([&](std::size_t, SceneFrame& frame) {
    frame.truth.reset();
    if (next != truth.end() && next->stamp == frame.stamp) {
      frame.truth = (next++)->T_world_sensor.translation();
    }
    frame.series.resize(frame.series.size() - kDistanceSeries);
    append_distances(frame.series, frame, true);
  });
}

}  // namespace mms
