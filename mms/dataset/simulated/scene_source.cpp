#include "mms/dataset/simulated/scene_source.hpp"

#include <algorithm>
#include <string>

#include "mms/core/size_text.hpp"
#include "mms/dataset/recorder/recorded_frame.hpp"
#include "mms/dataset/simulated/map_truth.hpp"
#include "mms/dataset/simulated/objects_truth.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

class SceneSource final : public FrameSource {
 public:
  SceneSource(const SceneConfig& config, bool load_masks, bool map_truth)
      : scene_(config),
        load_masks_(load_masks),
        keep_map_(map_truth),
        calibration_(std::make_shared<const Calibration>(
            recorded_calibration(scene_.calibration(), scene_.sensor()))) {
    for (int i = 0; i < scene_.size(); ++i) truth_.push_back(scene_.truth(i));
    motion_.samples = scene_.motion();
    describe_motion(motion_, "the scene", "the scene");
    feed_.add(motion_.samples);
  }

  std::optional<Frame> next() override {
    if (position_ >= size()) return std::nullopt;
    const std::size_t index = position_++;
    const SimulatedFrame simulated = scene_.render(static_cast<int>(index));
    if (keep_map_) {
      map_.add(simulated, truth_[index].T_world_sensor);
      objects_.push_back(object_frame(simulated.frame.stamp, simulated.objects));
    }
    Frame frame = as_recorded(simulated, scene_.config(), scene_.sensor());
    if (!load_masks_) frame.mask = {};
    feed_.attach(frame);
    return frame;
  }

  std::size_t size() const override { return static_cast<std::size_t>(scene_.size()); }
  std::size_t skipped() const override { return 0; }
  bool has_masks() const override { return load_masks_; }
  std::shared_ptr<const Calibration> calibration() const override { return calibration_; }
  void skip(std::size_t count) override { position_ += std::min(count, size() - position_); }
  const Trajectory& ground_truth() const override { return truth_; }
  void on_warning(WarningHandler) override {}
  void add_motion(MotionRecording motion) override { feed_.add(std::move(motion.samples)); }

  std::optional<TruthCloud> map_truth() const override {
    TruthCloud cloud = map_.cloud();
    if (cloud.points.empty()) return std::nullopt;
    return cloud;
  }

  ObjectHistory objects_truth() const override { return objects_; }

  std::vector<std::string> describe() const override {
    const SceneConfig& config = scene_.config();
    const SensorPreset& sensor = scene_.sensor();
    const CameraIntrinsics& camera = sensor.color.intrinsics;
    std::vector<std::string> facts = {
        "layout: simulated scene " + config.name + ", seed " + std::to_string(config.seed),
        "frames: " + std::to_string(size()) + " at " +
            format_number(config.hz > 0.0 ? config.hz : sensor.hz) + " Hz",
        "sensor: " + std::string(sensor.name) + ", " +
            (sensor.lidar ? "LiDAR and camera, " : "depth camera, ") +
            size_text(camera.width, camera.height) + " pixels",
        masks_fact(), "truth: exact"};
    facts.insert(facts.end(), motion_.facts.begin(), motion_.facts.end());
    return facts;
  }

 private:
  std::string masks_fact() const {
    if (!load_masks_) return "masks: none";
    return scene_.config().mask_errors.enabled ? "masks: with errors" : "masks: exact";
  }

  SimulatedScene scene_;
  bool load_masks_;
  bool keep_map_;
  std::shared_ptr<const Calibration> calibration_;
  Trajectory truth_;
  MapTruth map_;
  ObjectHistory objects_;
  MotionRecording motion_;
  MotionFeed feed_;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> play_scene(const SceneConfig& config, bool load_masks,
                                        bool map_truth) {
  return std::make_unique<SceneSource>(config, load_masks, map_truth);
}

}  // namespace mms
