#include <OpenNI.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <optional>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/dataset/camera/camera_choice.hpp"
#include "mms/dataset/camera/openni2_device.hpp"

namespace mms {
namespace {

using openni::OpenNI;
using openni::PixelFormat;
using openni::VideoMode;
using openni::VideoStream;

constexpr int kCameraRate = 30;  // preferred [Hz]
constexpr const char* kOpeningHint =
    "another program may use it, or its USB device may not be permitted; see docs/cameras.md";

/// What OpenNI2 says of the last fault, in one line.
std::string openni_fault() {
  std::string text = OpenNI::getExtendedError();
  for (char& c : text) {
    if (c == '\n' || c == '\t') c = ' ';
  }
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "unknown fault";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// OpenNI2 with its drivers, for the time of its use.
class OpenNiLibrary {
 public:
  OpenNiLibrary() {
    if (OpenNI::initialize() == openni::STATUS_OK) return;
    const std::string fault = openni_fault();
    OpenNI::shutdown();
    throw DataError("OpenNI2", "cannot start: " + fault,
                    "Debian's libopenni2-0 has it and its drivers");
  }
  ~OpenNiLibrary() { OpenNI::shutdown(); }
  OpenNiLibrary(const OpenNiLibrary&) = delete;
  OpenNiLibrary& operator=(const OpenNiLibrary&) = delete;
};

std::string format_name(PixelFormat format) {
  switch (format) {
    case openni::PIXEL_FORMAT_DEPTH_1_MM:
      return "1 mm";
    case openni::PIXEL_FORMAT_DEPTH_100_UM:
      return "0.1 mm";
    case openni::PIXEL_FORMAT_SHIFT_9_2:
    case openni::PIXEL_FORMAT_SHIFT_9_3:
      return "shifts";
    case openni::PIXEL_FORMAT_RGB888:
      return "RGB888";
    case openni::PIXEL_FORMAT_YUV422:
      return "YUV422";
    case openni::PIXEL_FORMAT_GRAY8:
      return "gray, 8 bit";
    case openni::PIXEL_FORMAT_GRAY16:
      return "gray, 16 bit";
    case openni::PIXEL_FORMAT_JPEG:
      return "JPEG";
    default:
      return "format " + std::to_string(format);
  }
}

std::string mode_text(const VideoMode& mode) {
  return size_text(mode.getResolutionX(), mode.getResolutionY()) + ", " +
         std::to_string(mode.getFps()) + " Hz, " + format_name(mode.getPixelFormat());
}

/// Depth units per meter; 0 for another format.
double units_per_meter(PixelFormat format) {
  if (format == openni::PIXEL_FORMAT_DEPTH_1_MM) return 1000.0;
  return format == openni::PIXEL_FORMAT_DEPTH_100_UM ? 10'000.0 : 0.0;
}

bool is_usable(const VideoMode& mode, bool color) {
  const PixelFormat format = mode.getPixelFormat();
  return color ? format == openni::PIXEL_FORMAT_RGB888 : units_per_meter(format) > 0.0;
}

void add_modes(openni::Device& device, openni::SensorType type, const std::string& what,
               CameraInfo& info) {
  const openni::SensorInfo* sensor = device.getSensorInfo(type);
  if (sensor == nullptr) {
    info.modes.push_back(what + " none");
    return;
  }
  const auto& modes = sensor->getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    info.modes.push_back(what + " " + mode_text(modes[i]));
  }
}

/// The URI of the camera that an address names.
std::string uri_of(const std::string& address, const std::string& which) {
  openni::Array<openni::DeviceInfo> found;
  OpenNI::enumerateDevices(&found);
  std::vector<std::string> uris;
  for (int i = 0; i < found.getSize(); ++i) uris.emplace_back(found[i].getUri());
  if (uris.empty()) {
    throw DataError(address, "no camera was found",
                    "plug it in; drivers of other manufacturers go into OpenNI2/Drivers, see "
                    "docs/cameras.md");
  }
  return uris[chosen_camera(address, which, uris)];
}

/// Puts the columns in reverse order.
template <class Pixel>
void mirror_rows(Image<Pixel>& image) {
  for (int y = 0; y < image.height(); ++y) {
    std::reverse(image.row(y), image.row(y) + image.width());
  }
}

template <class Pixel>
const Pixel* frame_row(const openni::VideoFrameRef& frame, int y) {
  const auto* bytes = static_cast<const std::uint8_t*>(frame.getData());
  return reinterpret_cast<const Pixel*>(
      bytes + static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.getStrideInBytes()));
}

class OpenNi2Device final : public CameraDevice, private OpenNI::DeviceDisconnectedListener {
 public:
  /// @param what  address or file, for messages
  /// @param uri   of OpenNI2
  OpenNi2Device(std::string what, const std::string& uri) : what_(std::move(what)), uri_(uri) {
    if (device_.open(uri.c_str()) != openni::STATUS_OK) {
      throw DataError(what_, "cannot be opened: " + openni_fault(),
                      std::filesystem::exists(uri) ? "" : kOpeningHint);
    }
    if (device_.isFile()) {
      device_.getPlaybackControl()->setSpeed(-1.0F);  // one image with each call of read
      device_.getPlaybackControl()->setRepeatEnabled(false);
    }
    create_stream(color_, openni::SENSOR_COLOR, "color");
    create_stream(depth_, openni::SENSOR_DEPTH, "depth");
    if (!device_.isFile()) register_depth();
    for (Stream* stream : {&color_, &depth_}) {
      stream->video.setMirroringEnabled(false);
      stream->mirrored = stream->video.getMirroringEnabled();
    }
    OpenNI::addDeviceDisconnectedListener(this);
    for (Stream* stream : {&color_, &depth_}) {
      if (stream->video.start() == openni::STATUS_OK) continue;
      const std::string fault = openni_fault();
      OpenNI::removeDeviceDisconnectedListener(this);
      throw DataError(what_, std::string("gives no ") + stream->what + " images: " + fault,
                      kOpeningHint);
    }
    // Without it images are paired by their stamps alone.
    if (!device_.isFile()) device_.setDepthColorSyncEnabled(true);
  }

  ~OpenNi2Device() override {
    OpenNI::removeDeviceDisconnectedListener(this);
    for (Stream* stream : {&color_, &depth_}) {
      stream->video.stop();
      stream->video.destroy();
    }
    device_.close();
  }
  OpenNi2Device(const OpenNi2Device&) = delete;
  OpenNi2Device& operator=(const OpenNi2Device&) = delete;

  Event read(FrameAssembler& frames, std::chrono::milliseconds timeout) override {
    if (color_.at_end() && depth_.at_end()) return Event::kEnd;
    VideoStream* const streams[] = {&color_.video, &depth_.video};
    int ready = -1;
    const auto status = OpenNI::waitForAnyStream(const_cast<VideoStream**>(streams), 2, &ready,
                                                 static_cast<int>(timeout.count()));
    if (status == openni::STATUS_TIME_OUT) return unplugged_ ? Event::kEnd : Event::kNothing;
    Stream& stream = ready == 0 ? color_ : depth_;
    openni::VideoFrameRef image;
    if (status != openni::STATUS_OK || stream.video.readFrame(&image) != openni::STATUS_OK) {
      if (unplugged_) return Event::kEnd;
      throw DataError(what_, "cannot be read: " + openni_fault());
    }
    if (!image.isValid()) return Event::kNothing;
    check_size(image, ready == 0 ? sizeof(Rgb) : sizeof(std::uint16_t));
    count(stream, image.getFrameIndex());
    const Timestamp stamp(static_cast<std::int64_t>(image.getTimestamp()) * 1000);
    ready == 0 ? frames.add_color(stamp, color_of(image))
               : frames.add_depth(stamp, depth_of(image));
    return Event::kImage;
  }

  std::string name() const override {
    const openni::DeviceInfo& info = device_.getDeviceInfo();
    const std::string vendor = info.getVendor();
    return vendor + (vendor.empty() ? "" : " ") + info.getName();
  }

  std::optional<CameraIntrinsics> intrinsics() const override {
    const VideoMode mode = color_.video.getVideoMode();
    const int width = mode.getResolutionX();
    const int height = mode.getResolutionY();
    const auto focal_length = [](int side, double angle) {
      return 0.5 * side / std::tan(0.5 * angle);
    };
    return CameraIntrinsics{focal_length(width, color_.video.getHorizontalFieldOfView()),
                            focal_length(height, color_.video.getVerticalFieldOfView()),
                            0.5 * (width - 1),
                            0.5 * (height - 1),
                            width,
                            height,
                            {}};
  }

  bool registers_depth() const override { return true; }
  std::optional<double> depth_scale() const override {
    return units_per_meter(depth_.video.getVideoMode().getPixelFormat());
  }
  std::size_t size() const override { return static_cast<std::size_t>(color_.images); }
  std::size_t missed() const override { return missed_; }

 private:
  struct Stream {
    VideoStream video;
    const char* what = "";
    bool mirrored = false;
    int images = 0;  ///< of a recording
    int last = 0;    ///< number of the last image

    bool at_end() const { return images > 0 && last >= images; }
  };

  void create_stream(Stream& stream, openni::SensorType type, const char* what) {
    stream.what = what;
    if (!device_.hasSensor(type)) {
      throw DataError(what_, std::string("has no ") + what + " images",
                      "color and depth images are needed");
    }
    if (stream.video.create(device_, type) != openni::STATUS_OK) {
      throw DataError(what_, std::string("gives no ") + what + " images: " + openni_fault(),
                      kOpeningHint);
    }
    const bool color = type == openni::SENSOR_COLOR;
    if (device_.isFile()) {
      stream.images = device_.getPlaybackControl()->getNumberOfFrames(stream.video);
      const VideoMode mode = stream.video.getVideoMode();
      if (is_usable(mode, color)) return;
      throw DataError(what_, std::string("has ") + what + " images of " + mode_text(mode),
                      "colors must be RGB888, depth in mm or 0.1 mm");
    }
    const std::optional<VideoMode> mode = best_mode(stream.video, color);
    if (!mode) {
      throw DataError(what_,
                      std::string("has no ") + what + " images of 640x480 pixels, " +
                          (color ? "RGB888" : "in mm or 0.1 mm"),
                      "mms cameras lists its modes");
    }
    if (stream.video.setVideoMode(*mode) == openni::STATUS_OK) return;
    throw DataError(what_, std::string("refuses ") + what + " images of " + mode_text(*mode) +
                               ": " + openni_fault());
  }

  static std::optional<VideoMode> best_mode(const VideoStream& stream, bool color) {
    std::optional<VideoMode> best;
    const auto rank = [](const VideoMode& mode) {  // 30 Hz, else the fastest one
      return mode.getFps() == kCameraRate ? 1'000'000 : mode.getFps();
    };
    const auto& modes = stream.getSensorInfo().getSupportedVideoModes();
    for (int i = 0; i < modes.getSize(); ++i) {
      const VideoMode& mode = modes[i];
      const bool size =
          mode.getResolutionX() == kCameraWidth && mode.getResolutionY() == kCameraHeight;
      if (size && is_usable(mode, color) && (!best || rank(mode) > rank(*best))) best = mode;
    }
    return best;
  }

  void register_depth() {
    constexpr auto kMode = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    if (!device_.isImageRegistrationModeSupported(kMode)) {
      throw DataError(what_, "does not register its depth images to the color images",
                      "cameras that do: Asus Xtion, PrimeSense, Orbbec Astra");
    }
    if (device_.setImageRegistrationMode(kMode) == openni::STATUS_OK) return;
    throw DataError(what_, "cannot register depth to color images: " + openni_fault());
  }

  void count(Stream& stream, int number) {
    const int lost = number - stream.last - 1;
    if (&stream == &color_ && stream.last > 0 && lost > 0) {
      missed_ += static_cast<std::size_t>(lost);
    }
    stream.last = number;
  }

  /// Of a recording that is damaged, or of a faulty driver.
  void check_size(const openni::VideoFrameRef& frame, std::size_t pixel) const {
    const int width = frame.getWidth();
    const int height = frame.getHeight();
    const int row = frame.getStrideInBytes();
    const auto fits = [](int part, std::size_t size, int whole) {
      return part > 0 && whole > 0 &&
             static_cast<std::size_t>(part) * size <= static_cast<std::size_t>(whole);
    };
    if (row > 0 && fits(width, pixel, row) &&
        fits(height, static_cast<std::size_t>(row), frame.getDataSize())) {
      return;
    }
    throw DataError(what_, "has an image of " + size_text(width, height) + " pixels with " +
                               std::to_string(frame.getDataSize()) + " bytes");
  }

  Image<Rgb> color_of(const openni::VideoFrameRef& frame) const {
    static_assert(sizeof(Rgb) == 3);
    Image<Rgb> color(frame.getWidth(), frame.getHeight());
    for (int y = 0; y < color.height(); ++y) {
      std::memcpy(color.row(y), frame_row<Rgb>(frame, y),
                  sizeof(Rgb) * static_cast<std::size_t>(color.width()));
    }
    if (color_.mirrored) mirror_rows(color);
    return color;
  }

  Image<float> depth_of(const openni::VideoFrameRef& frame) const {
    const auto units = static_cast<float>(units_per_meter(frame.getVideoMode().getPixelFormat()));
    Image<float> depth(frame.getWidth(), frame.getHeight());
    for (int y = 0; y < depth.height(); ++y) {
      const auto* raw = frame_row<std::uint16_t>(frame, y);
      for (int x = 0; x < depth.width(); ++x) depth(x, y) = static_cast<float>(raw[x]) / units;
    }
    if (depth_.mirrored) mirror_rows(depth);
    return depth;
  }

  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    if (uri_ == info->getUri()) unplugged_ = true;
  }

  OpenNiLibrary library_;  // before the device, after which it ends
  std::string what_;
  std::string uri_;
  openni::Device device_;
  Stream color_, depth_;
  std::atomic<std::size_t> missed_ = 0;
  std::atomic<bool> unplugged_ = false;
};

}  // namespace

std::vector<CameraInfo> list_openni2_cameras() {
  const OpenNiLibrary library;
  openni::Array<openni::DeviceInfo> found;
  OpenNI::enumerateDevices(&found);
  std::vector<CameraInfo> cameras;
  for (int i = 0; i < found.getSize(); ++i) {
    CameraInfo info{std::string(kOpenNi2Address) + ":" + std::to_string(i),
                    found[i].getName(),
                    found[i].getVendor(),
                    found[i].getUri(),
                    {},
                    {}};
    openni::Device device;
    if (device.open(found[i].getUri()) == openni::STATUS_OK) {
      add_modes(device, openni::SENSOR_COLOR, "color", info);
      add_modes(device, openni::SENSOR_DEPTH, "depth", info);
      device.close();
    } else {
      info.fault = "cannot be opened: " + openni_fault();
    }
    cameras.push_back(std::move(info));
  }
  return cameras;
}

std::unique_ptr<CameraDevice> open_openni2_camera(const std::string& address,
                                                  const std::string& which) {
  const OpenNiLibrary library;  // devices found are kept while it runs
  return std::make_unique<OpenNi2Device>(address, uri_of(address, which));
}

std::unique_ptr<CameraDevice> open_oni(const std::filesystem::path& path) {
  return std::make_unique<OpenNi2Device>(path.string(), path.string());
}

}  // namespace mms
