#include "mms/io/results/trajectory_io.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/stamp_reader.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace {

constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kKittiColumns = 12;

void expect_columns(const TextTable& table, const TextLine& line, std::size_t columns,
                    const std::string& form) {
  if (line.fields.size() == columns) return;
  throw DataError(table.where(line), std::to_string(line.fields.size()) + " columns, expected " +
                                         std::to_string(columns) + ": " + form);
}

void expect_poses(const std::filesystem::path& path, const Trajectory& trajectory) {
  if (trajectory.empty()) throw DataError(path.string(), "has no poses");
}

Timestamp stamp_of(const TextTable& table, const TextLine& line, const StampReader& read_stamp) {
  const auto stamp = read_stamp(line.fields[0]);
  if (stamp) return *stamp;
  throw DataError(table.where(line), "'" + std::string(line.fields[0]) + "' is not a stamp",
                  "stamps are seconds below 9.2e9");
}

/// Whether the columns are those of EuRoC and TUM-VI: nanoseconds, position, quaternion from w on.
/// Velocity and biases may follow.
bool is_euroc(const TextTable& table) {
  const auto position_of = [&](std::string_view name) {
    return std::ranges::find_if(table.header(),
                                [&](std::string_view field) { return field.starts_with(name); });
  };
  const auto w = position_of("q_RS_w");
  return w != table.header().end() && w < position_of("q_RS_x");
}

StampedPose tum_pose(const TextTable& table, const TextLine& line, const StampReader& read_stamp) {
  const bool w_first = is_euroc(table);
  if (!w_first || line.fields.size() < kTumColumns) {
    expect_columns(table, line, kTumColumns, "stamp tx ty tz qx qy qz qw");
  }
  const std::string where = table.where(line);
  const auto n = parse_finite(std::span(line.fields).subspan(1, kTumColumns - 1), where);
  const Eigen::Quaterniond rotation = w_first ? Eigen::Quaterniond(n[3], n[4], n[5], n[6])
                                              : Eigen::Quaterniond(n[6], n[3], n[4], n[5]);
  constexpr double kMinNorm = 1e-6;
  if (rotation.norm() < kMinNorm) throw DataError(where, "the quaternion is zero");

  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
  return {stamp_of(table, line, read_stamp), Transform<World, Sensor>(pose)};
}

Trajectory tum_trajectory(const TextTable& table) {
  const StampReader read_stamp(table, 0, kLongestImageStep);
  Trajectory trajectory;
  for (const TextLine& line : table.lines()) {
    trajectory.push_back(tum_pose(table, line, read_stamp));
  }
  return trajectory;
}

Trajectory kitti_trajectory(const TextTable& table) {
  Trajectory trajectory;
  for (const TextLine& line : table.lines()) {
    expect_columns(table, line, kKittiColumns, "a 3x4 matrix, row-major");
    const std::string where = table.where(line);
    const Timestamp stamp = Timestamp() + kKittiPeriod * trajectory.size();
    trajectory.push_back({stamp, Transform<World, Sensor>(
                                     isometry_from_rows(parse_finite(line.fields, where), where))});
  }
  return trajectory;
}

bool is_kitti(const TextTable& table) {
  return !table.lines().empty() && table.lines()[0].fields.size() == kKittiColumns;
}

void append_row(std::string& text, std::span<const double> numbers) {
  for (const double number : numbers) {
    if (!text.empty() && text.back() != '\n') text += ' ';
    text += format_number(number);
  }
  text += '\n';
}

}  // namespace

Trajectory read_trajectory_tum(const std::filesystem::path& path) {
  Trajectory trajectory = tum_trajectory(TextTable(path));
  expect_poses(path, trajectory);
  return trajectory;
}

Trajectory read_trajectory_kitti(const std::filesystem::path& path,
                                 std::span<const Timestamp> stamps) {
  Trajectory trajectory = kitti_trajectory(TextTable(path));
  expect_poses(path, trajectory);
  if (stamps.empty()) return trajectory;
  if (stamps.size() != trajectory.size()) {
    throw DataError(path.string(), std::to_string(trajectory.size()) + " poses and " +
                                       std::to_string(stamps.size()) + " stamps");
  }
  for (std::size_t i = 0; i < stamps.size(); ++i) trajectory[i].stamp = stamps[i];
  return trajectory;
}

bool is_kitti_trajectory(const std::filesystem::path& path) {
  return is_kitti(TextTable(path));
}

Trajectory read_trajectory(const std::filesystem::path& path) {
  const TextTable table(path);
  Trajectory trajectory = is_kitti(table) ? kitti_trajectory(table) : tum_trajectory(table);
  expect_poses(path, trajectory);
  return trajectory;
}

void write_trajectory_tum(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::string text = "# stamp tx ty tz qx qy qz qw\n";
  for (const StampedPose& pose : trajectory) {
    const Eigen::Vector3d t = pose.T_world_sensor.translation();
    const Eigen::Quaterniond q(pose.T_world_sensor.rotation());
    text += pose.stamp.to_string();
    append_row(text, std::array{t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
  }
  write_file(path, text);
}

void write_trajectory_kitti(const std::filesystem::path& path, const Trajectory& trajectory) {
  std::string text;
  for (const StampedPose& pose : trajectory) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows =
        pose.T_world_sensor.isometry().matrix().topRows<3>();
    append_row(text, std::span(rows.data(), kKittiColumns));
  }
  write_file(path, text);
}

std::filesystem::path map_trajectory_file(const std::filesystem::path& folder) {
  const std::filesystem::path corrected = folder / "trajectory_map.tum";
  return std::filesystem::exists(corrected) ? corrected : folder / "trajectory.tum";
}

}  // namespace mms
