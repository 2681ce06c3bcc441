#include "mms/dataset/camera/oni_source.hpp"

#include <utility>

#include "mms/core/error.hpp"
#include "mms/dataset/camera/camera_calibration.hpp"
#include "mms/dataset/camera/oni_records.hpp"
#include "mms/dataset/camera/openni2_device.hpp"

namespace mms {
namespace {

constexpr auto kOniWait = std::chrono::seconds(2);  // for an image, of files without an end

class OniSource final : public FrameSource {
 public:
  OniSource(const std::filesystem::path& path, const SourceOptions& options)
      : path_(path.string()),
        device_(open_oni(path)),
        calibration_(
            camera_calibration(*device_, path_, options.camera, given_calibration(options.camera))),
        shared_(std::make_shared<const Calibration>(calibration_.calibration)),
        assembler_(FrameAssembler::Sensor::kDepth) {
    assembler_.set_camera(*shared_->camera);
  }

  std::optional<Frame> next() override {
    while (true) {
      if (std::optional<Frame> frame = take()) return frame;
      if (ended_) return std::nullopt;
      try {
        ended_ = device_->read(assembler_, kOniWait) != CameraDevice::Event::kImage;
      } catch (const Error& error) {
        ended_ = true;
        if (handler_) handler_(error.what());
      }
    }
  }

  std::size_t size() const override { return device_->size(); }
  std::size_t skipped() const override { return skipped_; }
  void skip(std::size_t count) override {
    while (count > 0 && next()) --count;
  }
  bool has_masks() const override { return false; }
  std::shared_ptr<const Calibration> calibration() const override { return shared_; }
  const Trajectory& ground_truth() const override { return no_truth_; }

  void add_motion(MotionRecording motion) override {
    motion_.add(std::move(motion.samples));
    motion_facts_ = std::move(motion.facts);
  }

  std::vector<std::string> describe() const override {
    const CameraIntrinsics& camera = *shared_->camera;
    std::vector<std::string> lines = {"layout: OpenNI",
                                      "sensor: depth camera, " + std::to_string(camera.width) +
                                          "x" + std::to_string(camera.height) + " pixels, " +
                                          calibration_.origin,
                                      "depth: taken as registered to the color images",
                                      "frames: " + std::to_string(size()), "ground truth: none"};
    lines.insert(lines.end(), motion_facts_.begin(), motion_facts_.end());
    return lines;
  }

  void on_warning(WarningHandler handler) override { handler_ = std::move(handler); }

 private:
  /// A frame that is complete.
  std::optional<Frame> take() {
    while (std::optional<Frame> frame = assembler_.next()) {
      frame->calibration = shared_;
      if (last_stamp_ && frame->stamp <= *last_stamp_) {
        ++skipped_;
        if (handler_) handler_("frame " + frame->name + " skipped: its stamp is not later");
        continue;
      }
      last_stamp_ = frame->stamp;
      motion_.attach(*frame);
      return frame;
    }
    return std::nullopt;
  }

  std::string path_;
  std::unique_ptr<CameraDevice> device_;
  CameraCalibration calibration_;
  std::shared_ptr<const Calibration> shared_;
  FrameAssembler assembler_;
  std::optional<Timestamp> last_stamp_;
  std::size_t skipped_ = 0;
  bool ended_ = false;
  MotionFeed motion_;
  std::vector<std::string> motion_facts_;
  Trajectory no_truth_;
  WarningHandler handler_;
};

}  // namespace

bool is_oni_name(const std::filesystem::path& path) {
  return path.extension() == ".oni";
}

std::unique_ptr<FrameSource> open_oni_recording(const std::filesystem::path& path,
                                                const SourceOptions& options) {
  if (!options.masks.empty()) {
    throw DataError(path.string(), "is a recording of OpenNI, which takes no masks",
                    "convert it to a folder with mms convert -o DIR");
  }
  check_oni_records(path);
  return std::make_unique<OniSource>(path, options);
}

}  // namespace mms
