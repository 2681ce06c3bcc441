#include "mms/dataset/lidar/scan_truth.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "mms/core/error.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

using Facts = std::vector<std::string>;

constexpr std::int64_t kMicrosecond = 1'000;         // [ns]
constexpr std::int64_t kSecondUnit = 1'000'000'000;  // [ns]

Eigen::Isometry3d make_pose(const Eigen::Vector3d& t, const Eigen::Matrix3d& R) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = t;
  T.linear() = R;
  return T;
}

Eigen::Matrix3d rotation_of(double roll, double pitch, double yaw) {
  return (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Rotation of a quaternion x y z w.
Eigen::Matrix3d rotation_of(std::span<const double> q, const std::string& where) {
  const Eigen::Quaterniond quaternion(q[3], q[0], q[1], q[2]);
  if (!(quaternion.norm() > 0.0)) throw DataError(where, "has a quaternion of zeros");
  return quaternion.normalized().toRotationMatrix();
}

/// The stamp in a column, whole numbers of `unit` [ns].
Timestamp stamp_at(const TextLine& line, std::size_t column, std::int64_t unit,
                   const std::string& where) {
  const std::int64_t end = std::numeric_limits<std::int64_t>::max() / unit;
  const auto value = parse_integer(line.fields[column]);
  if (value && *value >= 0 && *value < end) return Timestamp(*value * unit);
  throw DataError(where, "column " + std::to_string(column + 1) + " is not a stamp");
}

/// The poses of a table, each line by `pose_of(line, where)`.
template <class PoseOf>
Trajectory read_table(const fs::path& file, std::size_t columns, PoseOf pose_of) {
  Trajectory truth;
  const TextTable table(file);
  for (const TextLine& line : table.lines()) {
    const std::string where = table.where(line);
    if (line.fields.size() != columns) {
      throw DataError(where, "has " + std::to_string(line.fields.size()) + " columns, expected " +
                                 std::to_string(columns));
    }
    truth.push_back(pose_of(line, where));
  }
  return truth;
}

std::vector<double> numbers_from(const TextLine& line, std::size_t column,
                                 const std::string& where) {
  return parse_finite(std::span<const std::string_view>(line.fields).subspan(column), where);
}

/// Poses of the vehicle; the LiDAR's place on it is that of calib_base2ouster.txt.
Trajectory read_mulran_truth(const fs::path& file) {
  constexpr double kYaw = 179.6654 * std::numbers::pi / 180.0;
  const Eigen::Isometry3d T_base_lidar =
      make_pose(Eigen::Vector3d(1.7042, -0.021, 1.8047), rotation_of(0.0, 0.0, kYaw));
  return read_table(file, 13, [&](const TextLine& line, const std::string& where) {
    const auto pose = isometry_from_rows(numbers_from(line, 1, where), where) * T_base_lidar;
    return StampedPose{stamp_at(line, 0, 1, where), Transform<World, Sensor>(pose)};
  });
}

/// Rotation that turns z up.
Eigen::Isometry3d upside_down() {
  return make_pose(Eigen::Vector3d::Zero(), rotation_of(std::numbers::pi, 0.0, 0.0));
}

/// Poses of a body with z down: stamp [us], x y z, roll pitch yaw.
Trajectory read_nclt_truth(const fs::path& file) {
  Trajectory truth;
  const TextTable table(file);
  for (const TextLine& line : table.lines()) {
    const std::string where = table.where(line);
    if (line.fields.size() != 7) throw DataError(where, "has not 7 columns");
    if (line.fields[1] == "nan" || line.fields[1] == "NaN") continue;
    const auto n = numbers_from(line, 1, where);
    const auto pose =
        make_pose(Eigen::Vector3d(n[0], n[1], n[2]), rotation_of(n[3], n[4], n[5])) * upside_down();
    truth.push_back({stamp_at(line, 0, kMicrosecond, where), Transform<World, Sensor>(pose)});
  }
  return truth;
}

/// Poses of the camera's mount: seconds, nanoseconds, x y z, quaternion x y z w.
Trajectory read_newer_college_truth(const fs::path& file) {
  const double quaternion[] = {0.0, 0.0, 0.924, 0.383};
  const auto T_mount_lidar =
      make_pose(Eigen::Vector3d(-0.084, -0.025, 0.050), rotation_of(quaternion, ""));
  return read_table(file, 9, [&](const TextLine& line, const std::string& where) {
    const auto n = numbers_from(line, 2, where);
    const auto pose =
        make_pose(Eigen::Vector3d(n[0], n[1], n[2]), rotation_of(std::span(n).subspan(3), where)) *
        T_mount_lidar;
    const Timestamp stamp = stamp_at(line, 0, kSecondUnit, where) +
                            Duration(stamp_at(line, 1, 1, where).nanoseconds() % kSecondUnit);
    return StampedPose{stamp, Transform<World, Sensor>(pose)};
  });
}

/// Poses of the LiDAR: stamp [ns], x y z, quaternion x y z w.
Trajectory read_helipr_truth(const fs::path& file) {
  return read_table(file, 8, [&](const TextLine& line, const std::string& where) {
    const auto n = numbers_from(line, 1, where);
    const auto pose =
        make_pose(Eigen::Vector3d(n[0], n[1], n[2]), rotation_of(std::span(n).subspan(3), where));
    return StampedPose{stamp_at(line, 0, 1, where), Transform<World, Sensor>(pose)};
  });
}

/// The numbers of the line "NAME: ..." of a calibration file of KITTI raw.
std::vector<double> named_numbers(const fs::path& file, const std::string& name,
                                  std::size_t count) {
  const TextTable table(file);
  for (const TextLine& line : table.lines()) {
    if (line.fields[0] != name + ":") continue;
    std::vector<double> numbers = numbers_from(line, 1, table.where(line));
    if (numbers.size() == count) return numbers;
  }
  throw DataError(file.string(),
                  "has no line '" + name + ":' of " + std::to_string(count) + " numbers");
}

Eigen::Isometry3d read_rigid(const fs::path& file) {
  const auto R = named_numbers(file, "R", 9);
  const auto t = named_numbers(file, "T", 3);
  const std::vector<double> rows = {R[0], R[1], R[2], t[0], R[3], R[4],
                                    R[5], t[1], R[6], R[7], R[8], t[2]};
  return isometry_from_rows(rows, file.string());
}

fs::path imu_calibration(const fs::path& folder) {
  return absolute_folder(folder).parent_path() / "calib_imu_to_velo.txt";
}

/// Poses of the inertial unit from latitude and longitude (Mercator projection of KITTI's
/// development kit), altitude, roll, pitch and yaw.
Trajectory read_kitti_raw_truth(const fs::path& folder, const ScanLayout& layout,
                                std::span<const Timestamp> stamps) {
  constexpr double kEarthRadius = 6378137.0;  // [m]
  constexpr double kRadians = std::numbers::pi / 180.0;
  const Eigen::Isometry3d T_imu_lidar = read_rigid(imu_calibration(folder)).inverse();
  Trajectory truth;
  double scale = 0.0;
  for (std::size_t i = 0; i < layout.scans.size(); ++i) {
    const fs::path file = folder / "oxts" / "data" / (layout.scans[i].stem().string() + ".txt");
    if (!fs::exists(file)) continue;
    const TextTable table(file);
    if (table.lines().empty() || table.lines()[0].fields.size() < 6) {
      throw DataError(file.string(), "has not the six numbers of a pose");
    }
    const auto n = numbers_from(table.lines()[0], 0, table.where(table.lines()[0]));
    if (scale == 0.0) scale = std::cos(n[0] * kRadians);
    const Eigen::Vector3d t(
        scale * kEarthRadius * n[1] * kRadians,
        scale * kEarthRadius * std::log(std::tan(0.5 * (90.0 + n[0]) * kRadians)), n[2]);
    const auto pose = make_pose(t, rotation_of(n[3], n[4], n[5])) * T_imu_lidar;
    truth.push_back({stamps[i], Transform<World, Sensor>(pose)});
  }
  return truth;
}

/// The poses of the folder, or of the odometry benchmark: poses/00.txt for sequences/00.
fs::path find_kitti_poses(const fs::path& folder) {
  for (const std::string& name : list_folder(folder)) {
    if (name.starts_with("poses") && name.ends_with(".txt")) return folder / name;
  }
  const fs::path sequence = absolute_folder(folder);
  const fs::path root = sequence.parent_path().parent_path();
  const fs::path poses = root / "poses" / (sequence.filename().string() + ".txt");
  return fs::exists(poses) ? poses : fs::path();
}

Trajectory read_kitti_truth(const fs::path& file, const std::vector<fs::path>& scans,
                            std::span<const Timestamp> stamps,
                            const Eigen::Isometry3d& T_camera_lidar) {
  Trajectory truth;
  const Trajectory camera = read_trajectory_kitti(file);
  const std::vector<std::size_t> lines = lines_of_scans(scans, camera.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const std::size_t line = lines.empty() ? i : lines[i];
    if (line >= camera.size()) break;
    const auto pose = camera[line].T_world_sensor.isometry() * T_camera_lidar;
    truth.push_back({stamps[i], Transform<World, Sensor>(pose)});
  }
  return truth;
}

/// Whether a file of poses has the eight columns of TUM, and not the twelve of KITTI.
bool has_tum_poses(const fs::path& file) {
  constexpr std::size_t kColumns = 8;
  const TextTable table(file);
  return !table.lines().empty() && table.lines()[0].fields.size() == kColumns;
}

/// File of the ground truth of a data set; empty for none.
fs::path truth_file(const fs::path& folder, const ScanLayout& layout) {
  const fs::path whole = absolute_folder(folder);
  const fs::path sensor = absolute_folder(layout.scans.front().parent_path());
  switch (layout.dataset) {
    case ScanDataset::kKittiRaw:
      return folder / "oxts" / "data";
    case ScanDataset::kMulRan:
      return folder / "global_pose.csv";
    case ScanDataset::kNclt:
      return whole.parent_path() / "ground_truth" /
             ("groundtruth_" + whole.filename().string() + ".csv");
    case ScanDataset::kNewerCollege:
      return folder / "ground_truth" / "registered_poses.csv";
    case ScanDataset::kHeLiPR:
      return sensor.parent_path().parent_path() / "LiDAR_GT" /
             ("global_" + sensor.filename().string() + "_gt.txt");
    case ScanDataset::kKitti:
    case ScanDataset::kOther:
      return find_kitti_poses(folder);
  }
  return {};
}

}  // namespace

Trajectory read_scan_truth(const fs::path& folder, const ScanLayout& layout,
                           std::span<const Timestamp> stamps,
                           const Eigen::Isometry3d& T_camera_lidar, Facts& facts) {
  fs::path file = truth_file(folder, layout);
  const auto used = [&](Trajectory truth, const std::string& remark = "") {
    facts.push_back("poses: " + file.filename().string() + remark);
    return truth;
  };
  if (file.empty() || !fs::exists(file)) {
    file = folder / "groundtruth.txt";
    return fs::exists(file) ? used(read_trajectory_tum(file)) : Trajectory();
  }
  switch (layout.dataset) {
    case ScanDataset::kKittiRaw:
      if (!fs::exists(imu_calibration(folder))) {
        facts.emplace_back("poses: oxts/ not used, ../calib_imu_to_velo.txt is missing");
        return {};
      }
      return used(read_kitti_raw_truth(folder, layout, stamps), " of oxts/");
    case ScanDataset::kMulRan:
      return used(read_mulran_truth(file));
    case ScanDataset::kNclt:
      return used(read_nclt_truth(file));
    case ScanDataset::kNewerCollege:
      return used(read_newer_college_truth(file));
    case ScanDataset::kHeLiPR:
      return used(read_helipr_truth(file));
    default:
      if (has_tum_poses(file)) return used(read_trajectory_tum(file), " (TUM)");
      return used(read_kitti_truth(file, layout.scans, stamps, T_camera_lidar),
                  T_camera_lidar.matrix().isIdentity(0.0)
                      ? ", of camera 0 because T_camera_lidar is missing"
                      : "");
  }
}

}  // namespace mms
