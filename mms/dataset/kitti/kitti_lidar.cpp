#include "mms/dataset/kitti/kitti_lidar.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/dataset/kitti/kitti_calibration.hpp"
#include "mms/dataset/kitti/scan_files.hpp"
#include "mms/dataset/kitti/scan_records.hpp"
#include "mms/dataset/source/recorded_source.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

struct LidarRecording {
  std::vector<ScanFiles> scans;
  std::vector<Timestamp> stamps;
  int floats = 4;  ///< of a point
  std::shared_ptr<const Calibration> calibration;
  Eigen::Isometry3d T_truth_lidar = Eigen::Isometry3d::Identity();  ///< of the poses' camera
  Trajectory ground_truth;
  std::vector<std::string> facts;
};

class LidarSource final : public RecordedSource {
 public:
  LidarSource(LidarRecording recording, const fs::path& folder) : recording_(std::move(recording)) {
    set_ground_truth(std::move(recording_.ground_truth));
    set_map_truth(folder / "map_truth.ply");
    set_objects_truth(folder / "objects_truth.json");
  }

  std::size_t size() const override { return recording_.scans.size(); }
  bool has_masks() const override {
    return std::any_of(recording_.scans.begin(), recording_.scans.end(),
                       [](const ScanFiles& files) { return !files.mask.empty(); });
  }

 protected:
  Timestamp stamp_at(std::size_t index) const override { return recording_.stamps[index]; }
  std::string name_at(std::size_t index) const override {
    return recording_.scans[index].scan.stem().string();
  }
  Frame read(std::size_t index) const override {
    return read_scan_frame(recording_.scans[index], recording_.floats, recording_.calibration);
  }
  std::vector<std::string> facts() const override { return recording_.facts; }

 private:
  LidarRecording recording_;
};

/// Stamp of a file of nuScenes, as in N008__LIDAR_TOP__1532402927647951.pcd.bin [us].
std::optional<Timestamp> stamp_in_name(const fs::path& scan) {
  constexpr std::size_t kDigits = 16;
  constexpr std::int64_t kNanosecondsPerMicrosecond = 1000;
  const std::string name = scan.filename().string();
  const std::size_t begin = name.rfind("__");
  if (begin == std::string::npos) return std::nullopt;
  const auto digits = std::string_view(name).substr(begin + 2, kDigits);
  const auto number = parse_integer(digits);
  if (!number || digits.size() != kDigits) return std::nullopt;
  return Timestamp(*number * kNanosecondsPerMicrosecond);
}

bool read_stamps_in_names(LidarRecording& recording) {
  std::vector<Timestamp> stamps;
  for (const ScanFiles& files : recording.scans) {
    const auto stamp = stamp_in_name(files.scan);
    if (!stamp) return false;
    stamps.push_back(*stamp);
  }
  recording.stamps = std::move(stamps);
  recording.facts.emplace_back("stamps: names of the scans [us]");
  return true;
}

void read_times(LidarRecording& recording, const fs::path& folder) {
  const std::size_t count = recording.scans.size();
  const fs::path file = folder / "times.txt";
  if (!fs::exists(file)) {
    if (read_stamps_in_names(recording)) return;
    for (std::size_t i = 0; i < count; ++i)
      recording.stamps.push_back(Timestamp() + kKittiPeriod * i);
    recording.facts.emplace_back("stamps: none, 10 Hz assumed");
    return;
  }
  const TextTable table(file);
  for (const TextLine& line : table.lines()) {
    const auto stamp = parse_stamp(line.fields[0]);
    if (!stamp) throw DataError(table.where(line), "is not a stamp in seconds");
    recording.stamps.push_back(*stamp);
  }
  if (recording.stamps.size() != count) {
    throw DataError(file.string(), "has " + std::to_string(recording.stamps.size()) +
                                       " stamps for " + std::to_string(count) + " scans");
  }
  recording.facts.emplace_back("stamps: times.txt");
}

/// The poses of the folder, or of the odometry benchmark: poses/00.txt for sequences/00.
fs::path find_poses(const fs::path& folder) {
  for (const std::string& name : list_folder(folder)) {
    if (name.starts_with("poses") && name.ends_with(".txt")) return folder / name;
  }
  fs::path sequence = fs::absolute(folder).lexically_normal();
  if (!sequence.has_filename()) sequence = sequence.parent_path();  // trailing slash
  const fs::path root = sequence.parent_path().parent_path();
  const fs::path poses = root / "poses" / (sequence.filename().string() + ".txt");
  return fs::exists(poses) ? poses : fs::path();
}

void read_poses(LidarRecording& recording, const fs::path& folder) {
  const fs::path file = find_poses(folder);
  if (file.empty()) return;
  const Trajectory camera = read_trajectory_kitti(file);
  const Eigen::Isometry3d& to_camera = recording.T_truth_lidar;
  for (std::size_t i = 0; i < std::min(camera.size(), recording.stamps.size()); ++i) {
    const Eigen::Isometry3d pose = camera[i].T_world_sensor.isometry() * to_camera;
    recording.ground_truth.push_back({recording.stamps[i], Transform<World, Sensor>(pose)});
  }
  const bool identity = to_camera.matrix().isIdentity(0.0);
  recording.facts.push_back("poses: " + file.filename().string() +
                            (identity ? ", of camera 0 because T_camera_lidar is missing" : ""));
}

/// An image of camera 2; empty for none.
fs::path first_image(const fs::path& folder) {
  const fs::path images = folder / "image_2";
  if (!fs::is_directory(images)) return {};
  for (const std::string& name : list_folder(images)) {
    if (name.ends_with(".png") || name.ends_with(".jpg")) return images / name;
  }
  return {};
}

void read_calibration_of(LidarRecording& recording, const fs::path& folder) {
  const fs::path own = folder / "calibration.yaml";
  const fs::path kitti = folder / "calib.txt";
  Calibration calibration;
  if (fs::exists(own)) {
    calibration = read_calibration(own);
    recording.T_truth_lidar = calibration.T_camera_lidar.isometry();
    recording.facts.emplace_back("calibration: calibration.yaml");
  } else if (fs::exists(kitti)) {
    const KittiCalibration read = read_kitti_calibration(kitti, first_image(folder));
    calibration = read.calibration;
    recording.T_truth_lidar = read.T_camera0_lidar;
    recording.facts.emplace_back("calibration: calib.txt (KITTI odometry, camera 2)");
  } else {
    recording.facts.emplace_back("calibration: none");
  }
  recording.calibration = std::make_shared<const Calibration>(calibration);
}

}  // namespace

bool is_kitti_lidar_layout(const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(), [](const std::string& name) {
    return name.ends_with(".bin") || name == "velodyne";
  });
}

std::unique_ptr<FrameSource> open_kitti_lidar(const fs::path& folder,
                                              const SourceOptions& options) {
  LidarRecording recording;
  recording.scans = find_scans(folder);
  recording.facts.emplace_back("layout: KITTI LiDAR scans");
  recording.floats = floats_per_point(recording.scans);
  recording.facts.push_back("points: " + std::to_string(recording.floats) + " float32 each");
  read_calibration_of(recording, folder);
  read_times(recording, folder);
  read_poses(recording, folder);
  find_companions(recording.scans, folder, *recording.calibration, options, recording.facts);
  return std::make_unique<LidarSource>(std::move(recording), folder);
}

}  // namespace mms
