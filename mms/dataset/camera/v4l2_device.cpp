#include "mms/dataset/camera/v4l2_device.hpp"

#include <linux/videodev2.h>
#include <poll.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <tuple>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/dataset/camera/camera_choice.hpp"
#include "mms/dataset/camera/v4l2_node.hpp"
#include "mms/io/image/image_io.hpp"

namespace mms {
namespace {

constexpr int kMaxNodes = 64;  // /dev/video0 to /dev/video63, as many as Linux numbers by default
constexpr int kPreferredRate = 30;  // [Hz]

/// What a camera of V4L2 has: the nodes of one USB port.
struct V4l2Camera {
  std::string name;
  std::string bus;
  std::vector<V4l2Node> nodes;
  std::string fault;  ///< why it cannot be opened
};

bool is_depth(const V4l2Mode& mode) {
  return mode.format == V4L2_PIX_FMT_Z16;
}

bool is_color(const V4l2Mode& mode) {
  return mode.format == V4L2_PIX_FMT_YUYV || mode.format == V4L2_PIX_FMT_MJPEG;
}

using ModeTest = bool (*)(const V4l2Mode&);

/// The first node with such images; null if there is none.
V4l2Node* node_with(V4l2Camera& camera, ModeTest test) {
  for (V4l2Node& node : camera.nodes) {
    if (std::any_of(node.modes().begin(), node.modes().end(), test)) return &node;
  }
  return nullptr;
}

std::string missing_images(V4l2Camera& camera) {
  if (!camera.fault.empty()) return camera.fault;
  if (node_with(camera, is_depth) == nullptr) return "has no depth images (Z16)";
  if (node_with(camera, is_color) == nullptr) return "has no color images (YUYV or MJPG)";
  return "";
}

std::vector<V4l2Camera> find_cameras() {
  std::vector<V4l2Camera> cameras;
  for (int number = 0; number < kMaxNodes; ++number) {
    const std::string path = "/dev/video" + std::to_string(number);
    try {
      std::optional<V4l2Node> node = V4l2Node::open(path);
      if (!node || node->modes().empty()) continue;
      auto camera = std::find_if(cameras.begin(), cameras.end(), [&](const V4l2Camera& known) {
        return known.bus == node->bus() && !known.bus.empty();
      });
      if (camera == cameras.end()) {
        cameras.push_back({node->name(), node->bus(), {}, {}});
        camera = cameras.end() - 1;
      }
      camera->nodes.push_back(std::move(*node));
    } catch (const DataError& error) {
      cameras.push_back({"", path, {}, error.what()});
    }
  }
  return cameras;
}

/// "depth 640x480, 90/60/30 Hz, Z16, /dev/video0" for each size and format that can be used.
std::vector<std::string> mode_lines(const V4l2Node& node) {
  std::vector<std::string> lines;
  const V4l2Mode* last = nullptr;
  std::string rates;
  const auto end_line = [&] {
    if (last == nullptr) return;
    lines.push_back((is_depth(*last) ? "depth " : "color ") + size_text(last->width, last->height) +
                    ", " + rates + " Hz, " + format_name(last->format) + ", " + node.path());
  };
  for (const V4l2Mode& mode : node.modes()) {
    if (!is_depth(mode) && !is_color(mode)) continue;
    const std::string rate = mode.rate > 0 ? std::to_string(mode.rate) : "unknown";
    const bool same = last != nullptr && last->format == mode.format && last->width == mode.width &&
                      last->height == mode.height;
    if (!same) end_line();
    rates = same ? rates + "/" + rate : rate;
    last = &mode;
  }
  end_line();
  return lines;
}

/// The camera that an address names.
V4l2Camera chosen(const std::string& address, const std::string& which) {
  std::vector<V4l2Camera> cameras = find_cameras();
  if (cameras.empty()) {
    throw DataError(address, "no camera was found", "plug it in; there is no file /dev/video*");
  }
  if (which.empty()) {
    const auto usable = std::find_if(cameras.begin(), cameras.end(), [](V4l2Camera& camera) {
      return missing_images(camera).empty();
    });
    return std::move(usable == cameras.end() ? cameras.front() : *usable);
  }
  std::vector<std::string> buses;
  for (V4l2Camera& camera : cameras) {
    const bool has_file = std::any_of(camera.nodes.begin(), camera.nodes.end(),
                                      [&](const V4l2Node& node) { return node.path() == which; });
    if (has_file) return std::move(camera);
    buses.push_back(camera.bus);
  }
  return std::move(cameras[chosen_camera(address, which, buses)]);
}

/// The mode of this size at 30 Hz, else the fastest one; not compressed, if both are.
std::optional<V4l2Mode> best_mode(const V4l2Node& node, ModeTest test,
                                  const CameraIntrinsics& size) {
  const auto rank = [](const V4l2Mode& mode) {
    return std::tuple(mode.rate == kPreferredRate, mode.rate, mode.format != V4L2_PIX_FMT_MJPEG);
  };
  std::optional<V4l2Mode> best;
  for (const V4l2Mode& mode : node.modes()) {
    if (!test(mode) || mode.width != size.width || mode.height != size.height) continue;
    if (!best || rank(mode) > rank(*best)) best = mode;
  }
  return best;
}

class V4l2Device final : public CameraDevice {
 public:
  V4l2Device(const std::string& address, V4l2Camera camera, const Calibration& given)
      : what_(address), camera_(std::move(camera)), depth_scale_(given.depth_scale) {
    if (const std::string missing = missing_images(camera_); !missing.empty()) {
      throw DataError(what_, missing, camera_.fault.empty() ? "both are needed" : "");
    }
    if (!given.camera) {
      throw DataError(what_, "needs a calibration, for V4L2 tells none",
                      "--calibration FILE; docs/cameras.md says how to get one");
    }
    color_ = {.node = node_with(camera_, is_color), .what = "color", .formats = "YUYV or MJPG"};
    depth_ = {.node = node_with(camera_, is_depth), .what = "depth", .formats = "Z16"};
    if (color_.node == depth_.node) {
      throw DataError(what_, "gives color and depth images only one after the other",
                      "it needs a file of its own for each");
    }
    start(color_, is_color, *given.camera);
    start(depth_, is_depth, given.depth_camera ? given.depth_camera->camera : *given.camera);
  }

  Event read(FrameAssembler& frames, std::chrono::milliseconds timeout) override {
    pollfd files[] = {{color_.node->descriptor(), POLLIN, 0},
                      {depth_.node->descriptor(), POLLIN, 0}};
    const int ready = ::poll(files, std::size(files), static_cast<int>(timeout.count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) return Event::kNothing;
    bool any = false;
    bool unplugged = false;
    for (Stream* stream : {&color_, &depth_}) {
      const short event = files[stream == &color_ ? 0 : 1].revents;
      if (event == 0) continue;
      const V4l2Node::Taken taken =
          stream->node->take([&](const V4l2Node::RawImage& image) { add(*stream, image, frames); });
      const bool error = (event & (POLLERR | POLLHUP | POLLNVAL)) != 0;
      if (taken == V4l2Node::Taken::kImage) any = true;
      // A driver with a fault goes on with errors, without images.
      if (taken == V4l2Node::Taken::kUnplugged || (taken != V4l2Node::Taken::kImage && error)) {
        unplugged = true;
      }
    }
    if (any) return Event::kImage;
    return unplugged ? Event::kEnd : Event::kNothing;
  }

  std::string name() const override { return camera_.name; }
  std::optional<CameraIntrinsics> intrinsics() const override { return std::nullopt; }
  bool registers_depth() const override { return false; }
  std::optional<double> depth_scale() const override { return std::nullopt; }
  std::size_t size() const override { return 0; }
  std::size_t missed() const override { return missed_; }

 private:
  struct Stream {
    V4l2Node* node = nullptr;
    const char* what = "";
    const char* formats = "";
    V4l2Mode mode{};
    std::optional<std::uint32_t> last{};  ///< number of the last image
  };

  void start(Stream& stream, ModeTest test, const CameraIntrinsics& size) {
    const std::optional<V4l2Mode> mode = best_mode(*stream.node, test, size);
    if (!mode) {
      throw DataError(what_,
                      std::string("has no ") + stream.what + " images of " +
                          size_text(size.width, size.height) + " pixels in " + stream.formats,
                      "the size is that of the calibration; mms cameras lists the modes");
    }
    stream.mode = *mode;
    stream.node->start(*mode);
  }

  void add(Stream& stream, const V4l2Node::RawImage& image, FrameAssembler& frames) {
    const bool color = &stream == &color_;
    if (color && stream.last) {
      const std::uint32_t lost = image.number - *stream.last - 1;
      if (lost < kMaxGap) missed_ += lost;
    }
    stream.last = image.number;
    if (!convert(stream.mode.format, image, frames) && color) ++missed_;
  }

  /// @returns false for a damaged image
  bool convert(std::uint32_t format, const V4l2Node::RawImage& image, FrameAssembler& frames) {
    if (format == V4L2_PIX_FMT_MJPEG) {
      try {
        Image<Rgb> color = decode_color(image.bytes, what_);
        if (color.width() != image.layout.width || color.height() != image.layout.height) {
          return false;
        }
        frames.add_color(image.stamp, std::move(color));
        return true;
      } catch (const DataError&) {
        return false;
      }
    }
    if (!holds_image(image.bytes, image.layout)) return false;
    if (format == V4L2_PIX_FMT_Z16) {
      frames.add_depth(image.stamp, depth_from_z16(image.bytes, image.layout, depth_scale_));
    } else {
      frames.add_color(image.stamp, color_from_yuyv(image.bytes, image.layout));
    }
    return true;
  }

  /// A larger step between two numbers is a driver that counts anew.
  static constexpr std::uint32_t kMaxGap = 10'000;

  std::string what_;
  V4l2Camera camera_;
  double depth_scale_;
  Stream color_, depth_;
  std::atomic<std::size_t> missed_ = 0;
};

}  // namespace

std::vector<CameraInfo> list_v4l2_cameras() {
  std::vector<CameraInfo> infos;
  for (V4l2Camera& camera : find_cameras()) {
    CameraInfo info;
    info.address = std::string(kV4l2Address) + ":" + std::to_string(infos.size());
    info.name = camera.name;
    info.uri = camera.bus;
    for (const V4l2Node& node : camera.nodes) {
      for (std::string& line : mode_lines(node)) info.modes.push_back(std::move(line));
    }
    info.fault = missing_images(camera);
    infos.push_back(std::move(info));
  }
  return infos;
}

std::unique_ptr<CameraDevice> open_v4l2_camera(const std::string& address, const std::string& which,
                                               const Calibration& given) {
  return std::make_unique<V4l2Device>(address, chosen(address, which), given);
}

}  // namespace mms
