#include <functional>

#include "mms/dataset/recorder/recorded_frame.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/dataset/recorder/recording_layout.hpp"
#include "mms/geometry/parallel.hpp"
#include "mms/io/cloud/kitti_io.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

class KittiLayout final : public RecordingLayout {
 public:
  KittiLayout(fs::path folder, const SceneConfig& config, const SensorPreset& sensor)
      : folder_(std::move(folder)), config_(config), sensor_(sensor) {
    for (const char* kind : {"velodyne", "point_times", "image_2", "masks", "instances"}) {
      make_folder(folder_ / kind);
    }
  }

  std::string color_file(const Frame& frame) const override {
    return "image_2/" + recorded_name(frame, sensor_) + ".jpg";
  }

  void add(const SimulatedFrame& simulated) override {
    const Frame& frame = simulated.frame;
    if (times_.empty()) {
      const Calibration calibration = recorded_calibration(*frame.calibration, sensor_);
      write_calibration(folder_ / "calibration.yaml", calibration);
      T_lidar_camera_ = calibration.T_camera_lidar.isometry().inverse();
    }
    times_ += frame.stamp.to_string() + "\n";
    const std::string name = recorded_name(frame, sensor_);
    write_kitti_scan(folder_ / "velodyne" / (name + ".bin"), frame.scan);
    if (!frame.scan.time_offset.empty()) {
      write_point_times(folder_ / "point_times" / (name + ".bin"), frame.scan.time_offset);
    }
    if (!frame.color.empty()) add_images(simulated, name + ".png");
  }

  void finish(const Trajectory& truth) override {
    Trajectory camera;
    for (const StampedPose& pose : truth) {
      camera.push_back(
          {pose.stamp, Transform<World, Sensor>(pose.T_world_sensor.isometry() * T_lidar_camera_)});
    }
    write_file(folder_ / "times.txt", times_);
    write_trajectory_kitti(folder_ / "poses.txt", camera);
  }

 private:
  void add_images(const SimulatedFrame& simulated, const std::string& label_file) {
    const Frame& frame = simulated.frame;
    const std::function<void()> files[] = {
        [&] { write_file(folder_ / color_file(frame), recorded_color(frame, sensor_)); },
        [&] { write_png(folder_ / "masks" / label_file, recorded_mask(simulated, config_)); },
        [&] { write_png(folder_ / "instances" / label_file, simulated.exact.object); }};
    parallel_chunks(std::size(files), 1, [&](std::size_t i, std::size_t) { files[i](); });
  }

  fs::path folder_;
  SceneConfig config_;
  SensorPreset sensor_;
  std::string times_;
  Eigen::Isometry3d T_lidar_camera_ = Eigen::Isometry3d::Identity();
};

}  // namespace

std::unique_ptr<RecordingLayout> kitti_layout(const fs::path& folder, const SceneConfig& config,
                                              const SensorPreset& sensor) {
  return std::make_unique<KittiLayout>(folder, config, sensor);
}

}  // namespace mms
