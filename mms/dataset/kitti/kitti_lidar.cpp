#include "mms/dataset/kitti/kitti_lidar.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/dataset/kitti/scan_files.hpp"
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
  std::shared_ptr<const Calibration> calibration;
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
    return read_scan_frame(recording_.scans[index], recording_.calibration);
  }
  std::vector<std::string> facts() const override { return recording_.facts; }

 private:
  LidarRecording recording_;
};

void read_times(LidarRecording& recording, const fs::path& folder) {
  const std::size_t count = recording.scans.size();
  const fs::path file = folder / "times.txt";
  if (!fs::exists(file)) {
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

void read_poses(LidarRecording& recording, const fs::path& folder) {
  for (const std::string& name : list_folder(folder)) {
    if (!name.starts_with("poses") || !name.ends_with(".txt")) continue;
    const Trajectory camera = read_trajectory_kitti(folder / name);
    const auto to_camera = recording.calibration->T_camera_lidar.isometry();
    for (std::size_t i = 0; i < std::min(camera.size(), recording.stamps.size()); ++i) {
      const Eigen::Isometry3d pose = camera[i].T_world_sensor.isometry() * to_camera;
      recording.ground_truth.push_back({recording.stamps[i], Transform<World, Sensor>(pose)});
    }
    const bool identity = to_camera.matrix().isIdentity(0.0);
    recording.facts.push_back("poses: " + name +
                              (identity ? ", of camera 0 because T_camera_lidar is missing" : ""));
    return;
  }
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
  const fs::path calibration = folder / "calibration.yaml";
  recording.calibration = std::make_shared<const Calibration>(
      fs::exists(calibration) ? read_calibration(calibration) : Calibration());
  recording.facts.emplace_back(fs::exists(calibration) ? "calibration: calibration.yaml"
                                                       : "calibration: none");
  read_times(recording, folder);
  read_poses(recording, folder);
  find_companions(recording.scans, folder, *recording.calibration, options, recording.facts);
  return std::make_unique<LidarSource>(std::move(recording), folder);
}

}  // namespace mms
