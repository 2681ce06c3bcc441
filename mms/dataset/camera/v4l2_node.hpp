#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/dataset/camera/v4l2_pixels.hpp"

namespace mms {

/// A kind of images that a V4L2 node offers.
struct V4l2Mode {
  std::uint32_t format = 0;  ///< fourcc, V4L2_PIX_FMT_...
  int width = 0;             ///< [px]
  int height = 0;            ///< [px]
  int rate = 0;              ///< [Hz]; 0: unknown
};

/// "640x480, 30 Hz, YUYV".
std::string to_string(const V4l2Mode& mode);

/// Letters of a fourcc: "YUYV".
std::string format_name(std::uint32_t format);

/// A file of V4L2, /dev/video0, that gives images. Move-only; streams until its end.
class V4l2Node {
 public:
  /// An image, valid during the call that gets it.
  struct RawImage {
    std::span<const std::uint8_t> bytes;
    RawImageLayout layout;
    std::uint32_t number = 0;  ///< counts images, also lost ones
    Timestamp stamp;           ///< of CLOCK_MONOTONIC
  };

  enum class Taken { kImage, kDamaged, kNothing, kUnplugged };

  /// @param path  "/dev/video0"
  /// @returns nullopt if there is no such file, or it gives no images by streaming
  /// @throws DataError if it cannot be opened.
  static std::optional<V4l2Node> open(const std::string& path);

  V4l2Node(V4l2Node&& other) noexcept;
  V4l2Node& operator=(V4l2Node&& other) = delete;
  ~V4l2Node();

  const std::string& path() const { return path_; }
  const std::string& name() const { return name_; }  ///< of the camera
  /// Of the USB port; the same for all nodes of a camera.
  const std::string& bus() const { return bus_; }
  const std::vector<V4l2Mode>& modes() const { return modes_; }
  int descriptor() const { return file_; }

  /// Begins to give images.
  /// @throws DataError if it does not.
  void start(const V4l2Mode& mode);

  /// The next image that has arrived, without waiting.
  /// @throws DataError if it cannot be read.
  Taken take(const std::function<void(const RawImage&)>& use);

 private:
  V4l2Node(std::string path, int file) : path_(std::move(path)), file_(file) {}

  void read_modes();
  void map_buffers();
  [[noreturn]] void fail(const std::string& what) const;

  std::string path_;
  int file_ = -1;
  std::string name_;
  std::string bus_;
  std::vector<V4l2Mode> modes_;
  RawImageLayout layout_;
  std::vector<std::span<std::uint8_t>> buffers_;  ///< shared with the driver
  bool streams_ = false;
};

}  // namespace mms
