#include <functional>

#include "mms/dataset/recorder/recorded_frame.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/dataset/recorder/recording_layout.hpp"
#include "mms/geometry/parallel.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

class TumLayout final : public RecordingLayout {
 public:
  TumLayout(fs::path folder, const SceneConfig& config, const SensorPreset& sensor)
      : folder_(std::move(folder)), config_(config), sensor_(sensor) {
    for (const char* kind : {"rgb", "depth", "masks", "instances"}) make_folder(folder_ / kind);
  }

  std::string color_file(const Frame& frame) const override {
    return "rgb/" + recorded_name(frame, sensor_) + ".jpg";
  }

  void add(const SimulatedFrame& simulated) override {
    const Frame& frame = simulated.frame;
    if (color_list_.empty()) {
      write_calibration(folder_ / "calibration.yaml",
                        recorded_calibration(*frame.calibration, sensor_));
    }
    const Timestamp depth_stamp = frame.stamp + frame.depth_offset;
    const std::string depth_file = "depth/" + depth_stamp.to_string() + ".png";
    color_list_ += frame.stamp.to_string() + " " + color_file(frame) + "\n";
    depth_list_ += depth_stamp.to_string() + " " + depth_file + "\n";
    const std::string name = recorded_name(frame, sensor_) + ".png";
    const std::function<void()> files[] = {
        [&] { write_file(folder_ / color_file(frame), recorded_color(frame, sensor_)); },
        [&] { write_png(folder_ / depth_file, recorded_depth(frame.depth, sensor_.depth_scale)); },
        [&] { write_png(folder_ / "masks" / name, recorded_mask(simulated, config_)); },
        [&] { write_png(folder_ / "instances" / name, simulated.exact.object); }};
    parallel_chunks(std::size(files), 1, [&](std::size_t i, std::size_t) { files[i](); });
  }

  void finish(const Trajectory&) override {
    write_file(folder_ / "rgb.txt", "# stamp file\n" + color_list_);
    write_file(folder_ / "depth.txt", "# stamp file\n" + depth_list_);
  }

 private:
  fs::path folder_;
  SceneConfig config_;
  SensorPreset sensor_;
  std::string color_list_;
  std::string depth_list_;
};

}  // namespace

std::unique_ptr<RecordingLayout> tum_layout(const fs::path& folder, const SceneConfig& config,
                                            const SensorPreset& sensor) {
  return std::make_unique<TumLayout>(folder, config, sensor);
}

std::unique_ptr<RecordingLayout> layout_for(const fs::path& folder, const SceneConfig& config,
                                            const SensorPreset& sensor) {
  return sensor.lidar ? kitti_layout(folder, config, sensor) : tum_layout(folder, config, sensor);
}

}  // namespace mms
