// A driver of OpenNI2 whose camera gives the frames of a recording, for tests. Variables:
//   MMS_TEST_CAMERA         recording of 640x480 pixels; without it there is no camera
//   MMS_TEST_CAMERA_PERIOD  between two frames [ms], by default 33
//   MMS_TEST_CAMERA_FAULT   "busy", "no color", "no mode", "no registration", "mirrored", "silent"
// After the last frame it is unplugged. A mirrored one cannot be told to be otherwise. A silent one
// stays plugged in instead.

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>

#include "mms/dataset/open_dataset.hpp"

namespace {

using oni::driver::DeviceBase;
using oni::driver::StreamBase;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool has_fault(const char* fault) {
  return variable("MMS_TEST_CAMERA_FAULT") == fault;
}

template <class Value>
OniStatus give(const Value& value, void* data, const int* size) {
  if (*size != static_cast<int>(sizeof(Value))) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof(Value));
  return ONI_STATUS_OK;
}

class RecordedStream final : public StreamBase {
 public:
  RecordedStream(OniSensorType type, const OniVideoMode& mode, const mms::CameraIntrinsics& camera)
      : type_(type), mode_(mode), camera_(camera) {}

  OniStatus start() override {
    running_ = true;
    return ONI_STATUS_OK;
  }
  void stop() override { running_ = false; }
  bool running() const { return running_; }

  OniBool isPropertySupported(int id) override {
    return static_cast<OniBool>(
        id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV ||
        id == ONI_STREAM_PROPERTY_VERTICAL_FOV || id == ONI_STREAM_PROPERTY_MIRRORING ||
        id == ONI_STREAM_PROPERTY_STRIDE || id == ONI_STREAM_PROPERTY_CROPPING);
  }

  OniStatus getProperty(int id, void* data, int* size) override {
    switch (id) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(mode_, data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(static_cast<float>(2.0 * std::atan(0.5 * kWidth / camera_.fx)), data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(static_cast<float>(2.0 * std::atan(0.5 * kHeight / camera_.fy)), data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(static_cast<OniBool>(mirrored_), data, size);
      case ONI_STREAM_PROPERTY_STRIDE:
        return give(stride(), data, size);
      case ONI_STREAM_PROPERTY_CROPPING:
        return give(OniCropping{}, data, size);
      default:
        return ONI_STATUS_NOT_SUPPORTED;
    }
  }

  OniStatus setProperty(int id, const void* data, int) override {
    if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
      const auto& mode = *static_cast<const OniVideoMode*>(data);
      const bool same = mode.pixelFormat == mode_.pixelFormat && mode.fps == mode_.fps &&
                        mode.resolutionX == kWidth && mode.resolutionY == kHeight;
      return same ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
    }
    if (id != ONI_STREAM_PROPERTY_MIRRORING || has_fault("mirrored"))
      return ONI_STATUS_NOT_SUPPORTED;
    mirrored_ = *static_cast<const OniBool*>(data) != 0;
    return ONI_STATUS_OK;
  }

  /// For recorders, which ask for it once.
  void notifyAllProperties() override {
    const auto raise = [this](int id, const auto& value) {
      raisePropertyChanged(id, &value, sizeof value);
    };
    raise(ONI_STREAM_PROPERTY_VIDEO_MODE, mode_);
    raise(ONI_STREAM_PROPERTY_HORIZONTAL_FOV,
          static_cast<float>(2.0 * std::atan(0.5 * kWidth / camera_.fx)));
    raise(ONI_STREAM_PROPERTY_VERTICAL_FOV,
          static_cast<float>(2.0 * std::atan(0.5 * kHeight / camera_.fy)));
    raise(ONI_STREAM_PROPERTY_MIRRORING, static_cast<OniBool>(mirrored_));
    raise(ONI_STREAM_PROPERTY_STRIDE, stride());
    raise(ONI_STREAM_PROPERTY_CROPPING, OniCropping{});
  }

  template <class Pixel>
  void give_image(const std::vector<Pixel>& pixels, int number, mms::Timestamp stamp) {
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    auto* target = static_cast<Pixel*>(frame->data);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const int from = mirrored_ ? kWidth - 1 - x : x;
        target[y * kWidth + x] = pixels[static_cast<std::size_t>(y * kWidth + from)];
      }
    }
    frame->frameIndex = number;
    frame->videoMode = mode_;
    frame->width = kWidth;
    frame->height = kHeight;
    frame->cropOriginX = frame->cropOriginY = 0;
    frame->croppingEnabled = FALSE;
    frame->sensorType = type_;
    frame->stride = stride();
    frame->dataSize = frame->stride * kHeight;
    frame->timestamp = static_cast<std::uint64_t>(stamp.nanoseconds() / 1000);
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

 private:
  int stride() const { return mode_.resolutionX * (type_ == ONI_SENSOR_COLOR ? 3 : 2); }

  OniSensorType type_;
  OniVideoMode mode_;
  mms::CameraIntrinsics camera_;
  std::atomic<bool> mirrored_ = true;  // as real ones at their start
  std::atomic<bool> running_ = false;
};

class RecordedDevice final : public DeviceBase {
 public:
  explicit RecordedDevice(std::function<void()> unplug)
      : unplug_(std::move(unplug)), source_(mms::open_dataset(variable("MMS_TEST_CAMERA"))) {
    const bool other = has_fault("no mode");
    const int width = other ? 320 : kWidth;
    const int height = other ? 240 : kHeight;
    modes_[0] = {ONI_PIXEL_FORMAT_DEPTH_1_MM, width, height, 30};
    modes_[1] = {ONI_PIXEL_FORMAT_RGB888, width, height, 30};
    sensors_[0] = {ONI_SENSOR_DEPTH, 1, &modes_[0]};
    sensors_[1] = {ONI_SENSOR_COLOR, 1, &modes_[1]};
  }

  ~RecordedDevice() override {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  RecordedDevice(const RecordedDevice&) = delete;
  RecordedDevice& operator=(const RecordedDevice&) = delete;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = has_fault("no color") ? 1 : 2;
    return ONI_STATUS_OK;
  }

  StreamBase* createStream(OniSensorType type) override {
    const int index = type == ONI_SENSOR_COLOR ? 1 : 0;
    auto& stream = streams_[index];
    stream = std::make_unique<RecordedStream>(type, modes_[index], *source_->calibration()->camera);
    if (!thread_.joinable()) thread_ = std::thread([this] { play(); });
    return stream.get();
  }
  void destroyStream(StreamBase* gone) override {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    for (auto& stream : streams_) {
      if (stream.get() == gone) stream.reset();
    }
  }

  OniBool isPropertySupported(int id) override {
    return static_cast<OniBool>(id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION);
  }
  OniStatus setProperty(int id, const void*, int) override {
    return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override {
    return static_cast<OniBool>(mode == ONI_IMAGE_REGISTRATION_OFF ||
                                !has_fault("no registration"));
  }

 private:
  bool both_run() const {
    return streams_[0] && streams_[1] && streams_[0]->running() && streams_[1]->running();
  }

  void play() {
    using Clock = std::chrono::steady_clock;
    while (!ended_ && !both_run()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::string given = variable("MMS_TEST_CAMERA_PERIOD");
    const std::chrono::milliseconds period(given.empty() ? 33 : std::stoi(given));
    auto due = Clock::now() + std::chrono::milliseconds(200);
    int number = 0;
    while (!ended_) {
      const std::optional<mms::Frame> frame = source_->next();
      if (!frame) break;
      std::this_thread::sleep_until(due);
      due += period;
      if (ended_) return;
      std::vector<std::uint16_t> depth(frame->depth.size());
      for (std::size_t i = 0; i < depth.size(); ++i) {
        depth[i] = static_cast<std::uint16_t>(std::lround(1000.0F * frame->depth[i]));
      }
      ++number;
      streams_[1]->give_image(frame->color.pixels(), number, frame->stamp);
      streams_[0]->give_image(depth, number, frame->stamp);
    }
    std::this_thread::sleep_until(due);
    if (!ended_ && !has_fault("silent")) unplug_();
  }

  std::function<void()> unplug_;
  std::unique_ptr<mms::FrameSource> source_;
  OniVideoMode modes_[2];
  OniSensorInfo sensors_[2];
  std::unique_ptr<RecordedStream> streams_[2];
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

class RecordingDriver final : public oni::driver::DriverBase {
 public:
  explicit RecordingDriver(OniDriverServices* services) : DriverBase(services) {
    std::strcpy(info_.uri, "recording:0");
    std::strcpy(info_.vendor, "MMS-SLAM");
    std::strcpy(info_.name, "Recorded camera");
  }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    const OniStatus status = DriverBase::initialize(connected, disconnected, changed, cookie);
    if (!variable("MMS_TEST_CAMERA").empty()) deviceConnected(&info_);
    return status;
  }

  DeviceBase* deviceOpen(const char*, const char*) override {
    if (!has_fault("busy")) return new RecordedDevice([this] { deviceDisconnected(&info_); });
    getServices().errorLoggerAppend("the device is used by another program");
    return nullptr;
  }
  void deviceClose(DeviceBase* device) override { delete device; }
  void shutdown() override {}

  void* enableFrameSync(StreamBase**, int) override { return this; }

 private:
  OniDeviceInfo info_{};
};

}  // namespace

ONI_EXPORT_DRIVER(RecordingDriver)
