#include "mms/dataset/lidar/lidar_scans.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/dataset/lidar/kitti_calibration.hpp"
#include "mms/dataset/lidar/scan_files.hpp"
#include "mms/dataset/lidar/scan_layout.hpp"
#include "mms/dataset/lidar/scan_records.hpp"
#include "mms/dataset/lidar/scan_stamps.hpp"
#include "mms/dataset/lidar/scan_truth.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/recorded_source.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

struct LidarRecording {
  std::vector<ScanFiles> scans;
  ScanFormat format;
  std::vector<Timestamp> stamps;
  std::optional<AssumedRate> assumed_rate;  ///< if the recording has none
  std::shared_ptr<const Calibration> calibration;
  Trajectory ground_truth;
  std::vector<std::string> facts;
  std::vector<std::string> warnings;
};

class LidarSource final : public RecordedSource {
 public:
  LidarSource(LidarRecording recording, const fs::path& folder) : recording_(std::move(recording)) {
    set_ground_truth(std::move(recording_.ground_truth));
    set_assumed_rate(recording_.assumed_rate);
    set_map_truth(folder / "map_truth.ply");
    set_objects_truth(folder / "objects_truth.json");
    for (const std::string& warning : recording_.warnings) warn(warning);
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
    return read_scan_frame(recording_.scans[index], recording_.format, recording_.calibration);
  }
  std::vector<std::string> facts() const override { return recording_.facts; }

 private:
  LidarRecording recording_;
};

/// An image of camera 2; empty for none.
fs::path first_image(const fs::path& folder) {
  const fs::path images = folder / "image_2";
  if (!fs::is_directory(images)) return {};
  for (const std::string& name : list_folder(images)) {
    if (is_picture(name)) return images / name;
  }
  return {};
}

KittiCalibration read_calibration_of(const fs::path& folder, const CameraOptions& options,
                                     std::vector<std::string>& facts) {
  const fs::path own = options.file.empty() ? folder / "calibration.yaml" : options.file;
  const fs::path kitti = folder / "calib.txt";
  if (!options.file.empty() || fs::exists(own)) {
    facts.push_back("calibration: " + (options.file.empty() ? own.filename() : own).string());
    const Calibration calibration = read_any_calibration(own).calibration;
    return {calibration, calibration.T_camera_lidar.isometry()};
  }
  if (fs::exists(kitti)) {
    facts.emplace_back("calibration: calib.txt (KITTI odometry, camera 2)");
    return read_kitti_calibration(kitti, first_image(folder));
  }
  facts.emplace_back("calibration: none");
  return {};
}

/// Where the format says only that points are float32, their number is recognized.
ScanFormat format_of(const ScanLayout& layout, std::vector<std::string>& facts) {
  ScanFormat format = layout.format;
  if (format.kind != ScanFormat::Kind::kFloats) return format;
  const int floats = floats_per_point(layout.scans);
  facts.push_back("points: " + std::to_string(floats) + " float32 each");
  format.bytes = float_format(floats).bytes;
  format.has_intensity = float_format(floats).has_intensity;
  return format;
}

/// Warns of images whose place relative to the LiDAR is not known.
void check_extrinsics(LidarRecording& recording) {
  const bool has_images = std::any_of(
      recording.scans.begin(), recording.scans.end(),
      [](const ScanFiles& files) { return !files.color.empty() || !files.mask.empty(); });
  const Eigen::Isometry3d& T = recording.calibration->T_camera_lidar.isometry();
  if (!has_images || !T.matrix().isIdentity(0.0)) return;
  recording.warnings.emplace_back(
      "the calibration has no T_camera_lidar: camera and LiDAR are taken to have the same axes, "
      "so masks label other points; add it to calibration.yaml");
}

}  // namespace

bool is_lidar_scans_layout(const std::vector<std::string>& names) {
  return has_scans(names);
}

std::unique_ptr<FrameSource> open_lidar_scans(const fs::path& folder,
                                              const SourceOptions& options) {
  reject_image_options(folder, options.camera);
  const ScanLayout layout = find_scan_layout(folder);
  LidarRecording recording;
  recording.facts.push_back(std::string("layout: ") + layout.name);
  recording.facts.emplace_back("sensor: LiDAR");
  recording.format = format_of(layout, recording.facts);
  for (const fs::path& scan : layout.scans) recording.scans.push_back({scan, {}, {}, {}});
  const KittiCalibration calibration = read_calibration_of(folder, options.camera, recording.facts);
  recording.calibration = std::make_shared<const Calibration>(calibration.calibration);
  ScanStamps stamps = read_scan_stamps(folder, layout, recording.facts);
  recording.stamps = std::move(stamps.stamps);
  recording.assumed_rate = stamps.assumed_rate;
  recording.ground_truth = read_scan_truth(folder, layout, recording.stamps,
                                           calibration.T_camera0_lidar, recording.facts);
  find_companions(recording.scans, folder, *recording.calibration, options, recording.facts);
  check_extrinsics(recording);
  return std::make_unique<LidarSource>(std::move(recording), folder);
}

}  // namespace mms
