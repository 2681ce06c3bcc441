#include "mms/run/record/recorded_run.hpp"

#include <limits>
#include <map>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/config/config_yaml.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/io/results/objects_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/text_table.hpp"
#include "mms/run/record/recovered_run.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
/// Columns in milliseconds: read, the stages, their sum, and the interval between frames.
constexpr std::size_t kTimes = 3 + kStageCount;

/// Rows of timing.csv: stamp and times, without the sum.
std::map<Timestamp, std::vector<float>> read_times(const fs::path& file) {
  const TextTable table(file);
  std::map<Timestamp, std::vector<float>> times;
  for (const TextLine& line : table.lines()) {
    if (line.fields[0] == "stamp") continue;
    const auto stamp = parse_stamp(line.fields[0]);
    std::vector<float> values;
    for (std::size_t i = 1; i < line.fields.size() && i <= kTimes; ++i) {
      values.push_back(static_cast<float>(parse_double(line.fields[i]).value_or(kUnknown)));
    }
    if (!stamp || values.size() != kTimes) {
      throw DataError(table.where(line), "is not a row of timing.csv");
    }
    values.erase(values.end() - 2);
    times[*stamp] = std::move(values);
  }
  return times;
}

std::map<Timestamp, FrameRecord> read_frames(const fs::path& file) {
  std::map<Timestamp, FrameRecord> frames;
  for (const FrameRecord& frame : read_frame_records(file)) frames[frame.stamp] = frame;
  return frames;
}

/// Rows of loops.csv; an outcome has one word or two. Those of earlier versions have no
/// `dissimilarity`.
std::vector<LoopRecord> read_loops(const fs::path& file) {
  constexpr std::size_t kColumnsAfter = 11;  // the outcome, at least
  const TextTable table(file);
  std::vector<LoopRecord> loops;
  for (const TextLine& line : table.lines()) {
    const auto& fields = line.fields;
    if (fields[0] == "stamp") continue;
    const auto later = parse_stamp(fields[0]);
    const auto earlier = fields.size() > 1 ? parse_stamp(fields[1]) : std::nullopt;
    if (!later || !earlier || fields.size() < 3 + kColumnsAfter) {
      throw DataError(table.where(line), "is not a row of loops.csv");
    }
    LoopRecord loop{*earlier, *later, std::string(fields[2])};
    for (std::size_t i = 3; i < fields.size() && !parse_double(fields[i]); ++i) {
      loop.outcome.append(" ").append(fields[i]);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

MapCloud read_map(const fs::path& file) {
  PointCloudFile cloud = read_ply(file);
  remove_invalid_points(cloud);
  MapCloud map;
  map.points = std::move(cloud.points);
  map.colors = std::move(cloud.colors);
  map.normals = std::move(cloud.normals);
  map.colors.resize(map.points.size(), Rgb{128, 128, 128});
  map.normals.resize(map.points.size(), Eigen::Vector3f::Zero());
  return map;
}

/// Ignores settings of another version of the program.
SystemConfig read_settings(const fs::path& file) {
  SystemConfig config;
  try {
    if (fs::exists(file)) load_config(file, config);
  } catch (const ConfigError&) {
    return SystemConfig();
  }
  return config;
}

/// Poses of all frames: in the frame of the map if they are known there, else by the odometry.
Trajectory read_poses_of_frames(const fs::path& folder) {
  Trajectory poses = read_trajectory_tum(folder / "trajectory.tum");
  const fs::path corrected = map_trajectory_file(folder);
  if (corrected.filename() == "trajectory.tum") return poses;
  std::map<Timestamp, Transform<World, Sensor>> known;
  for (const StampedPose& pose : read_trajectory_tum(corrected)) {
    known.emplace(pose.stamp, pose.T_world_sensor);
  }
  for (StampedPose& pose : poses) {
    const auto found = known.find(pose.stamp);
    if (found != known.end()) pose.T_world_sensor = found->second;
  }
  return poses;
}

RunFiles read_finished(const fs::path& folder) {
  RunFiles files;
  files.trajectory = read_poses_of_frames(folder);
  const auto read = [&](const char* name, const auto& reader, auto& part) {
    if (!fs::exists(folder / name)) return;
    try {
      part = reader(folder / name);
    } catch (const Error& error) {
      files.warnings.emplace_back(error.what());
    }
  };
  read("static_map.ply", read_map, files.map);
  read("objects.json", read_objects, files.objects);
  read("truth.tum", read_trajectory_tum, files.truth);
  read("timing.csv", read_times, files.times);
  read("frames.csv", read_frames, files.frames);
  read("loops.csv", read_loops, files.loops);
  read("run.json", read_run_record, files.record);
  files.config = read_settings(folder / "config.yaml");
  if (files.record) files.data = files.record->data;
  return files;
}

RunFiles read_killed(const fs::path& journal) {
  RecoveredRun run = recover_run(journal);
  RunFiles files;
  files.trajectory = std::move(run.trajectory);
  files.map = std::move(run.map);
  files.config.static_map.voxel_size = run.header.voxel_size;
  files.data = run.header.data;
  return files;
}

}  // namespace

RunFiles read_run_files(const fs::path& folder) {
  if (!fs::exists(folder)) {
    throw FileError(folder.string(), "does not exist", "use a folder written by mms run");
  }
  if (!fs::is_directory(folder)) {
    throw FileError(folder.string(), "is not a folder", "use a folder written by mms run");
  }
  if (fs::exists(folder / "trajectory.tum")) return read_finished(folder);
  if (fs::exists(folder / kJournalName)) return read_killed(folder / kJournalName);
  throw DataError(folder.string(),
                  "is not a result folder: neither trajectory.tum nor " + std::string(kJournalName),
                  "use a folder written by mms run; to view a recording use mms run --view");
}

}  // namespace mms
