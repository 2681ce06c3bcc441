#include "mms/dataset/camera/camera_source.hpp"

#include <utility>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::size_t kCameraQueue = 100;                    // frames that may wait: 3 s
constexpr auto kImageWait = std::chrono::milliseconds(100);  // between checks of the end
constexpr auto kIdle = std::chrono::seconds(5);              // between warnings without frames

}  // namespace

CameraSource::CameraSource(const std::string& address, LiveCameraOptions options)
    : LiveSource(kCameraQueue),
      address_(address),
      options_(std::move(options)),
      given_calibration_(given_calibration(options_.calibration)),
      device_(open_camera(address, given_calibration_)),
      calibration_(camera_calibration(*device_, address, options_.calibration, given_calibration_)),
      shared_(std::make_shared<const Calibration>(calibration_.calibration)) {
  if (!options_.record.empty()) {
    recorder_ = std::make_unique<RecordingThread>(
        record_folder(options_.record), [this](const std::string& message) { warn(message); });
  }
  thread_ = std::thread([this] { capture(); });
}

CameraSource::~CameraSource() {
  ended_ = true;
  thread_.join();
}

std::optional<Frame> CameraSource::next() {
  if (given_ >= options_.frames) return std::nullopt;
  std::optional<Frame> frame = LiveSource::next();
  if (frame && ++given_ >= options_.frames) ended_ = true;
  return frame;
}

void CameraSource::capture() {
  try {
    FrameAssembler assembler(FrameAssembler::Sensor::kDepth);
    assembler.set_camera(*shared_->camera);
    if (shared_->depth_camera) assembler.set_depth_camera(*shared_->depth_camera);
    while (!ended_) {
      if (options_.stop && options_.stop()) return close();
      const CameraDevice::Event event = device_->read(assembler, kImageWait);
      if (take_frames(assembler)) assembler.report(1.0);  // counts from here on
      if (event == CameraDevice::Event::kEnd) {
        warn(address_ + " was unplugged: the run ends with the frames so far");
        break;
      }
      warn_if_idle(assembler);
    }
  } catch (const std::exception& error) {
    warn(error.what());
  }
  if (recorder_) recorder_->finish();
  end();
}

bool CameraSource::take_frames(FrameAssembler& assembler) {
  bool any = false;
  while (std::optional<Frame> frame = assembler.next()) {
    if (last_stamp_ && frame->stamp + FrameAssembler::kMaxStepBack < *last_stamp_) {
      warn(address_ + ": its clock went back: the run ends with the frames so far");
      ended_ = true;
      return any;
    }
    if (last_stamp_ && frame->stamp <= *last_stamp_) continue;
    last_frame_ = Clock::now();
    last_stamp_ = frame->stamp;
    frame->calibration = shared_;
    if (recorder_) recorder_->add(*frame);
    push(std::move(*frame));
    any = true;
  }
  return any;
}

void CameraSource::warn_if_idle(FrameAssembler& assembler) {
  const auto now = Clock::now();
  if (now - last_frame_ < kIdle) return;
  const std::chrono::duration<double> passed = now - last_frame_;
  last_frame_ = now;
  warn("no frames arrive from " + address_ + ": " + assembler.report(passed.count()));
}

std::vector<std::string> CameraSource::describe() const {
  const CameraIntrinsics& camera = *calibration_.calibration.camera;
  std::vector<std::string> lines = {
      "layout: live camera", "sensor: " + device_->name() + ", " + std::to_string(camera.width) +
                                 "x" + std::to_string(camera.height) + ", " + calibration_.origin};
  if (!device_->registers_depth()) {
    lines.push_back(calibration_.calibration.depth_camera
                        ? "depth: registered to the color images"
                        : "depth: taken as registered to the color images (no depth_camera in "
                          "the calibration)");
  }
  if (recorder_) lines.push_back("recording: " + options_.record.string());
  return lines;
}

}  // namespace mms
