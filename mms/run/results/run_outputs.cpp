#include "mms/run/results/run_outputs.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>

#include "mms/core/error.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/results/objects_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/mapping/static_map/semantic_map.hpp"
#include "mms/report/map_picture.hpp"
#include "mms/report/report.hpp"
#include "mms/run/results/result_files.hpp"
#include "mms/run/results/robot_maps.hpp"

namespace mms {
namespace {

/// Points higher above the first camera are omitted in the top view [m].
constexpr double kCeiling = 1.2;

std::string timing_csv(const RunLog& log) {
  std::string text = "stamp,read";
  for (std::size_t i = 0; i < kStageCount; ++i) {
    text += fmt::format(",{}", to_string(static_cast<Stage>(i)));
  }
  text += ",stages,interval\n";
  for (const LoggedFrame& frame : log.frames()) {
    fmt::format_to(std::back_inserter(text), "{},{:.3f}", frame.stamp.to_string(), frame.read_ms);
    for (const double ms : frame.stage_ms) fmt::format_to(std::back_inserter(text), ",{:.3f}", ms);
    fmt::format_to(std::back_inserter(text), ",{:.3f},{:.3f}\n", frame.stages_ms(),
                   frame.interval_ms);
  }
  return text;
}

std::string loops_csv(const RunLog& log) {
  std::string text =
      "stamp,earlier_stamp,outcome,inliers,overlap,contradiction,dissimilarity,sigma,tx,ty,tz,qx,"
      "qy,qz,qw\n";
  for (const Loop& loop : log.loops()) {
    const Eigen::Vector3d t = loop.T_candidate_query.translation();
    const Eigen::Quaterniond q(loop.T_candidate_query.linear());
    fmt::format_to(std::back_inserter(text),
                   "{},{},{},{},{:.3f},{:.4f},{:.3f},{:.4f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:."
                   "6f},{:.6f}\n",
                   log.stamp_of_keyframe(loop.query).to_string(),
                   log.stamp_of_keyframe(loop.candidate).to_string(), to_string(loop.outcome),
                   loop.inliers, loop.overlap, loop.contradiction, loop.dissimilarity, loop.sigma(),
                   t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

std::vector<ReportFrame> report_frames(const RunLog& log) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Transform<World, Sensor> unknown(Eigen::Isometry3d(Eigen::Translation3d(kNaN, kNaN, kNaN)));
  Trajectory poses;
  std::vector<ReportFrame> frames;
  for (const LoggedFrame& frame : log.frames()) {
    std::vector<double> times = {frame.read_ms};
    times.insert(times.end(), frame.stage_ms.begin(), frame.stage_ms.end());
    poses.push_back({frame.stamp, log.corrected_pose(frame).value_or(unknown)});
    frames.push_back({frame.stamp, poses.back().T_world_sensor, std::nullopt, frame.status,
                      frame.dynamic_share, std::move(times)});
  }
  const auto matches = match_by_stamp(log.truth(), poses, TrajectoryErrorOptions{}.max_difference);
  for (const PoseMatch& match : matches) {
    frames[match.estimate].truth_position =
        log.truth()[match.reference].T_world_sensor.translation();
  }
  return frames;
}

/// Positions by odometry, each session moved to the map at the first of its frames that is known
/// there; NaN for sessions without one.
std::vector<Eigen::Vector3d> odometry_in_map(const RunLog& log) {
  std::map<std::uint32_t, Eigen::Isometry3d> T_map_world;  // by session
  for (const LoggedFrame& frame : log.frames()) {
    const auto pose = log.corrected_pose(frame);
    if (!pose) continue;
    T_map_world.try_emplace(
        frame.session,
        Eigen::Isometry3d(pose->isometry() * frame.T_world_sensor.isometry().inverse()));
  }
  std::vector<Eigen::Vector3d> positions;
  for (const LoggedFrame& frame : log.frames()) {
    const auto T = T_map_world.find(frame.session);
    const Eigen::Vector3d unknown =
        Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    positions.push_back(T == T_map_world.end() ? unknown
                                               : T->second * frame.T_world_sensor.translation());
  }
  return positions;
}

/// The loops within the run.
ReportLoops report_loops(const RunLog& log) {
  ReportLoops result;
  std::map<Timestamp, std::size_t> frames;
  for (const LoggedFrame& frame : log.frames()) frames.emplace(frame.stamp, frames.size());
  std::array<std::int64_t, kLoopOutcomes> counts{};
  for (const Loop& loop : log.loops()) {
    ++counts[static_cast<std::size_t>(loop.outcome)];
    if (!log.is_own_keyframe(loop.candidate)) {  // its stamp is of another recording
      result.to_earlier_map += loop.outcome == LoopOutcome::kAccepted;
      continue;
    }
    const auto earlier = frames.find(log.stamp_of_keyframe(loop.candidate));
    const auto later = frames.find(log.stamp_of_keyframe(loop.query));
    const bool is_within = earlier != frames.end() && later != frames.end();
    if (loop.outcome != LoopOutcome::kAccepted || !is_within) continue;
    result.closed.emplace_back(earlier->second, later->second);
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto outcome = static_cast<LoopOutcome>(i);
    if (outcome == LoopOutcome::kAccepted || counts[i] == 0) continue;
    result.rejected.emplace_back(to_string(outcome), counts[i]);
  }
  if (!are_corrected(log.places())) return result;
  result.odometry = odometry_in_map(log);
  return result;
}

RunReport make_report(const std::string& data, const MapCloud& map, const MapCloud& with_objects,
                      double voxel_size, const RunLog& log) {
  RunReport report;
  report.name = data;
  report.up = log.has_image() ? UpAxis::kNegativeY : UpAxis::kPositiveZ;
  for (const auto& [name, unused] : log.metrics().stages) report.stages.push_back(name);
  report.frames = report_frames(log);
  report.loops = report_loops(log);
  report.summary = metric_sections(log.metrics());
  const MapPictureOptions view{.up = report.up, .point_size = voxel_size, .max_height = kCeiling};
  report.map_view = draw_map(map.points, map.colors, view);
  if (log.metrics().tracks > 0) {
    report.objects_view = draw_map(with_objects.points, with_objects.colors, view);
  }
  report.pictures = log.pictures();
  return report;
}

/// Writes the report's images as separate files.
void write_pictures(const std::filesystem::path& folder, const RunReport& report) {
  make_folder(folder);
  if (!report.map_view.empty()) write_png(folder / "map.png", report.map_view);
  if (!report.objects_view.empty()) write_png(folder / "objects.png", report.objects_view);
  for (std::size_t i = 0; i < report.pictures.size(); ++i) {
    write_png(folder / fmt::format("frame_{:02}.png", i + 1), report.pictures[i].image);
  }
}

/// The occupancy map of the run where no loop corrects it, else that of all keyframes of the map.
void write_corrected_robot_maps(const std::filesystem::path& folder, const SystemConfig& config,
                                const SlamSystem& system, const MapCloud& map, const RunLog& log) {
  if (!are_corrected(log.places())) {
    write_robot_maps(folder, system.occupancy_map(), system.static_map().cloud(), log.has_image());
    return;
  }
  const auto sessions = static_cast<std::uint32_t>(log.places().size());
  const OccupancyMap occupancy = map_occupancy(system.global_map(), sessions, config);
  write_robot_maps(folder, occupancy, map, log.has_image(), MapMarking::kObstacles);
}

/// Trajectory and map of the sessions whose place in the map is not known, each in its own frame.
void write_outside_map(const std::filesystem::path& folder, const SlamSystem& system,
                       const RunLog& log, MapFrame frame) {
  const std::vector<SessionPlace>& places = log.places();
  const bool are_known = std::all_of(places.begin(), places.end(),
                                     [](const SessionPlace& place) { return place.is_known; });
  if (are_known) return;
  make_folder(folder);
  std::vector<StampedMap> maps = system.mapping().session_maps();
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (places[i].is_known) continue;
    const std::string name = fmt::format("session_{}", i);
    const MapCloud map = places[i].corrected(std::move(maps[i]));
    write_ply(folder / (name + ".ply"), file_of(map, frame), ply_comments(frame));
    write_trajectory_tum(folder / (name + ".tum"), log.session_trajectory(i));
  }
}

}  // namespace

void write_outputs(const std::filesystem::path& folder, const std::string& data,
                   const SystemConfig& config, const SlamSystem& system, const RunLog& log,
                   const std::vector<std::string>& warnings) {
  const MapFrame frame = log.has_image() ? MapFrame::kCamera : MapFrame::kLidar;
  const MapCloud map = result_map(system.mapping(), frame, log.places());
  write_result_files(folder, log.trajectory(), log.keyframes(), map, frame);
  write_corrected_robot_maps(folder, config, system, map, log);
  write_file(folder / "objects.json", objects_json(log.objects()));
  const MapCloud with_objects = semantic_map(map, log.objects());
  write_ply(folder / "semantic_map.ply", file_of(with_objects, frame), ply_comments(frame));
  write_file(folder / "config.yaml", dump_config(config));
  write_metrics(folder / "metrics.json", log.metrics());
  if (log.metrics().loops) {
    write_trajectory_tum(folder / "trajectory_map.tum", log.corrected_trajectory());
    write_file(folder / "loops.csv", loops_csv(log));
  }
  write_outside_map(folder / "outside_map", system, log, frame);
  write_file(folder / "timing.csv", timing_csv(log));
  RunReport report = make_report(data, map, with_objects, system.static_map().voxel_size(), log);
  report.version = MMS_VERSION;
  report.settings = changed_settings(dump_config(config), dump_config(SystemConfig{}));
  report.warnings = warnings;
  write_report_html(folder / "report.html", report);
  write_pictures(folder / "pictures", report);
}

}  // namespace mms
