#include "apps/mms/commands/convert_files.hpp"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "apps/mms/console/overwrite_option.hpp"
#include "mms/core/error.hpp"
#include "mms/io/cloud/pcd_io.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/io/results/occupancy_grid_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/lower_case.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

enum class Format { kTum, kKitti, kPly, kPcd };

bool is_cloud(Format format) {
  return format == Format::kPly || format == Format::kPcd;
}

Format format_of(const fs::path& path) {
  const std::string extension = lower_case(path.extension().string());
  if (extension == ".tum") return Format::kTum;
  if (extension == ".txt") return Format::kKitti;
  if (extension == ".ply") return Format::kPly;
  if (extension == ".pcd") return Format::kPcd;
  throw DataError(
      path.string(),
      extension.empty() ? "has no extension" : "has the unknown extension '" + extension + "'",
      "supported: trajectories .tum (TUM) and .txt (KITTI), clouds .ply and .pcd");
}

/// TUM trajectories may be called .txt, so the number of columns decides.
Format format_of_input(const fs::path& path) {
  const Format format = format_of(path);
  if (is_cloud(format)) return format;
  return is_kitti_trajectory(path) ? Format::kKitti : Format::kTum;
}

/// a.tum and a_kitti.txt, a.ply and a.pcd.
fs::path other_file(const fs::path& input, Format format) {
  fs::path output = input;
  if (format == Format::kPly) return output.replace_extension(".pcd");
  if (format == Format::kPcd) return output.replace_extension(".ply");
  constexpr std::string_view kSuffix = "_kitti";
  std::string stem = input.stem().string();
  if (format == Format::kTum) return output.replace_filename(stem.append(kSuffix) + ".txt");
  if (stem.ends_with(kSuffix)) stem.resize(stem.size() - kSuffix.size());
  return output.replace_filename(stem + ".tum");
}

std::vector<Timestamp> read_stamps(const fs::path& path) {
  const TextTable table(path);
  std::vector<Timestamp> stamps;
  for (const TextLine& line : table.lines()) {
    const auto stamp = parse_stamp(line.fields[0]);
    if (!stamp) {
      throw DataError(table.where(line), "'" + std::string(line.fields[0]) + "' is not a stamp",
                      "stamps are seconds below 9.2e9");
    }
    stamps.push_back(*stamp);
  }
  if (stamps.empty()) throw DataError(path.string(), "has no stamps");
  return stamps;
}

/// From the world frame to the level one of the run's occupancy grid.
Transform<Map, World> level_transform(const fs::path& input) {
  return read_map_frame(input.parent_path() / "map.yaml").inverse();
}

void convert_cloud(const fs::path& input, Format from, const fs::path& output, Format to,
                   bool level) {
  PointCloudFile cloud = from == Format::kPly ? read_ply(input) : read_pcd(input);
  const std::size_t invalid = remove_invalid_points(cloud);
  std::vector<std::string> comments;
  if (level) {
    const Eigen::Isometry3f T_map_world = level_transform(input).isometry().cast<float>();
    for (Eigen::Vector3f& point : cloud.points) point = T_map_world * point;
    for (Eigen::Vector3f& normal : cloud.normals) normal = T_map_world.linear() * normal;
    comments = {"units: m", "frame: map, level, x forward at the start, y left, z up"};
  }
  to == Format::kPly ? write_ply(output, cloud, comments) : write_pcd(output, cloud);
  fmt::print("{}: {} points{}\n", output.string(), cloud.points.size(),
             invalid == 0 ? "" : fmt::format(", without {} that are not finite", invalid));
}

Trajectory read_poses(const fs::path& input, Format from, const fs::path& stamps) {
  if (from == Format::kTum && !stamps.empty()) {
    throw DataError("--stamps", "is " + stamps.string() + ", and " + input.string() + " has stamps",
                    "only KITTI trajectories need --stamps");
  }
  if (from == Format::kTum) return read_trajectory_tum(input);
  return stamps.empty() ? read_trajectory_kitti(input)
                        : read_trajectory_kitti(input, read_stamps(stamps));
}

void convert_trajectory(const fs::path& input, Format from, const fs::path& output, Format to,
                        const fs::path& stamps, bool level) {
  Trajectory trajectory = read_poses(input, from, stamps);
  if (level) {
    const Eigen::Isometry3d T_map_world = level_transform(input).isometry();
    for (StampedPose& pose : trajectory) {
      pose.T_world_sensor = Transform<World, Sensor>(T_map_world * pose.T_world_sensor.isometry());
    }
  }
  if (to == Format::kTum && from == Format::kKitti && stamps.empty()) {
    throw DataError(input.string(), "has no stamps, which TUM trajectories require",
                    "use --stamps FILE with one at the start of each line: times.txt, or the "
                    "original TUM trajectory");
  }
  to == Format::kTum ? write_trajectory_tum(output, trajectory)
                     : write_trajectory_kitti(output, trajectory);
  fmt::print("{}: {} poses{}\n", output.string(), trajectory.size(),
             from == Format::kTum && to == Format::kKitti ? ", without stamps" : "");
}

}  // namespace

void convert_file(const fs::path& input, const fs::path& given, const fs::path& stamps, bool level,
                  bool overwrite) {
  const Format from = format_of_input(input);
  const fs::path output = given.empty() ? other_file(input, from) : given;
  const Format to = format_of(output);
  if (is_cloud(from) != is_cloud(to)) {
    throw DataError(output.string(),
                    fmt::format("is a {}, but {} is a {}", is_cloud(to) ? "cloud" : "trajectory",
                                input.string(), is_cloud(from) ? "cloud" : "trajectory"),
                    is_cloud(from) ? "choose .ply or .pcd" : "choose .tum or .txt");
  }
  refuse_existing_file(output, overwrite);
  if (is_cloud(from)) return convert_cloud(input, from, output, to, level);
  convert_trajectory(input, from, output, to, stamps, level);
}

}  // namespace mms
