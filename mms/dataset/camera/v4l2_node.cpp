#include "mms/dataset/camera/v4l2_node.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"

namespace mms {
namespace {

constexpr std::uint32_t kImageBuffers = 4;  // of the driver: 0.1 s at 30 Hz
constexpr std::uint32_t kMaxKinds = 256;    // of formats, sizes or rates: a driver without end

/// @returns the error number, 0 for none
template <class Argument>
int control(int file, unsigned long request, Argument& argument) {
  while (::ioctl(file, request, &argument) < 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

bool is_gone(int error) {
  return error == ENODEV || error == ENXIO || error == ENOENT;
}

std::string hint_for(int error) {
  switch (error) {
    case EBUSY:
      return "another program uses it";
    case EACCES:
    case EPERM:
      return "its user must be in the group video: sudo usermod -aG video $USER, then log in again";
    case ENOSPC:
      return "the USB bus has no bandwidth left: use another port, of USB 3, or smaller images";
    default:
      return "plug it in again; docs/cameras.md";
  }
}

template <std::size_t Size>
std::string text_of(const std::uint8_t (&letters)[Size]) {
  const char* begin = reinterpret_cast<const char*>(letters);
  return std::string(begin, ::strnlen(begin, Size));
}

int rate_of(const v4l2_fract& interval) {
  if (interval.numerator == 0) return 0;
  return static_cast<int>(std::lround(static_cast<double>(interval.denominator) /
                                      static_cast<double>(interval.numerator)));
}

/// Rates of a format and size, the fastest first [Hz]; one 0 if they are unknown.
std::vector<int> rates_of(int file, std::uint32_t format, std::uint32_t width,
                          std::uint32_t height) {
  std::vector<int> rates;
  for (std::uint32_t i = 0; i < kMaxKinds; ++i) {
    v4l2_frmivalenum interval{};
    interval.index = i;
    interval.pixel_format = format;
    interval.width = width;
    interval.height = height;
    if (control(file, VIDIOC_ENUM_FRAMEINTERVALS, interval) != 0) break;
    const bool discrete = interval.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    rates.push_back(rate_of(discrete ? interval.discrete : interval.stepwise.min));
    if (!discrete) break;
  }
  if (rates.empty()) rates.push_back(0);
  std::sort(rates.rbegin(), rates.rend());
  return rates;
}

}  // namespace

std::string format_name(std::uint32_t format) {
  std::string name;
  for (int shift = 0; shift < 32; shift += 8) {
    const char letter = static_cast<char>(format >> shift & 0x7FU);
    name += letter >= ' ' && letter <= '~' ? letter : '?';
  }
  while (!name.empty() && name.back() == ' ') name.pop_back();
  return name;
}

std::string to_string(const V4l2Mode& mode) {
  return size_text(mode.width, mode.height) + ", " +
         (mode.rate > 0 ? std::to_string(mode.rate) + " Hz, " : "") + format_name(mode.format);
}

std::optional<V4l2Node> V4l2Node::open(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) {
    if (is_gone(errno)) return std::nullopt;
    throw DataError(path, std::string("cannot be opened: ") + std::strerror(errno),
                    hint_for(errno));
  }
  V4l2Node node(path, file);
  v4l2_capability capability{};
  if (control(file, VIDIOC_QUERYCAP, capability) != 0) return std::nullopt;
  const std::uint32_t can = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                ? capability.device_caps
                                : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) return std::nullopt;
  node.name_ = text_of(capability.card);
  node.bus_ = text_of(capability.bus_info);
  node.read_modes();
  return node;
}

V4l2Node::V4l2Node(V4l2Node&& other) noexcept
    : path_(std::move(other.path_)),
      file_(std::exchange(other.file_, -1)),
      name_(std::move(other.name_)),
      bus_(std::move(other.bus_)),
      modes_(std::move(other.modes_)),
      layout_(other.layout_),
      buffers_(std::exchange(other.buffers_, {})),
      streams_(std::exchange(other.streams_, false)) {}

V4l2Node::~V4l2Node() {
  if (streams_) {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    control(file_, VIDIOC_STREAMOFF, type);
  }
  for (const auto& buffer : buffers_) ::munmap(buffer.data(), buffer.size());
  if (file_ >= 0) ::close(file_);
}

void V4l2Node::read_modes() {
  for (std::uint32_t i = 0; i < kMaxKinds; ++i) {
    v4l2_fmtdesc format{};
    format.index = i;
    format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (control(file_, VIDIOC_ENUM_FMT, format) != 0) return;
    for (std::uint32_t k = 0; k < kMaxKinds; ++k) {
      v4l2_frmsizeenum size{};
      size.index = k;
      size.pixel_format = format.pixelformat;
      if (control(file_, VIDIOC_ENUM_FRAMESIZES, size) != 0) break;
      const bool discrete = size.type == V4L2_FRMSIZE_TYPE_DISCRETE;
      const std::uint32_t width = discrete ? size.discrete.width : size.stepwise.max_width;
      const std::uint32_t height = discrete ? size.discrete.height : size.stepwise.max_height;
      for (const int rate : rates_of(file_, format.pixelformat, width, height)) {
        modes_.push_back(
            {format.pixelformat, static_cast<int>(width), static_cast<int>(height), rate});
      }
      if (!discrete) break;
    }
  }
}

void V4l2Node::fail(const std::string& what) const {
  const int error = errno;
  throw DataError(path_, what + ": " + std::strerror(error), hint_for(error));
}

void V4l2Node::start(const V4l2Mode& mode) {
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_pix_format& pixels = format.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(mode.width);
  pixels.height = static_cast<std::uint32_t>(mode.height);
  pixels.pixelformat = mode.format;
  pixels.field = V4L2_FIELD_NONE;
  const std::string what = "gives no images of " + to_string(mode);
  if (control(file_, VIDIOC_S_FMT, format) != 0) fail(what);
  layout_ = {static_cast<int>(pixels.width), static_cast<int>(pixels.height), pixels.bytesperline};
  if (layout_.width != mode.width || layout_.height != mode.height ||
      pixels.pixelformat != mode.format) {
    throw DataError(path_, what + ", but of " + size_text(layout_.width, layout_.height) + ", " +
                               format_name(pixels.pixelformat));
  }
  if (mode.rate > 0) {
    // A camera that refuses keeps a rate of its own.
    v4l2_streamparm parameters{};
    parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    parameters.parm.capture.timeperframe = {1, static_cast<std::uint32_t>(mode.rate)};
    control(file_, VIDIOC_S_PARM, parameters);
  }
  map_buffers();
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (control(file_, VIDIOC_STREAMON, type) != 0) fail(what);
  streams_ = true;
}

void V4l2Node::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = kImageBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (control(file_, VIDIOC_REQBUFS, request) != 0) fail("gives no images");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer{};
    buffer.index = i;
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    if (control(file_, VIDIOC_QUERYBUF, buffer) != 0) fail("gives no images");
    void* memory = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, file_,
                          static_cast<off_t>(buffer.m.offset));
    if (memory == MAP_FAILED) fail("gives no memory for images");
    buffers_.emplace_back(static_cast<std::uint8_t*>(memory), buffer.length);
    if (control(file_, VIDIOC_QBUF, buffer) != 0) fail("gives no images");
  }
}

V4l2Node::Taken V4l2Node::take(const std::function<void(const RawImage&)>& use) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  if (const int error = control(file_, VIDIOC_DQBUF, buffer); error != 0) {
    if (error == EAGAIN) return Taken::kNothing;
    if (is_gone(error)) return Taken::kUnplugged;
    if (error == EIO) return Taken::kDamaged;  // lost on the bus; the driver goes on
    errno = error;
    fail("cannot be read");
  }
  const bool known = buffer.index < buffers_.size();
  const bool damaged = !known || (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  if (!damaged) {
    const auto clock = buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK;
    using std::chrono::steady_clock;
    const Duration since_start =
        clock == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC
            ? Duration(std::chrono::seconds(buffer.timestamp.tv_sec) +
                       std::chrono::microseconds(buffer.timestamp.tv_usec))
            : std::chrono::duration_cast<Duration>(steady_clock::now().time_since_epoch());
    const auto& memory = buffers_[buffer.index];
    use({memory.first(std::min<std::size_t>(buffer.bytesused, memory.size())), layout_,
         buffer.sequence, Timestamp(since_start.count())});
  }
  if (known) {
    if (const int error = control(file_, VIDIOC_QBUF, buffer); error != 0) {
      if (is_gone(error)) return Taken::kUnplugged;
      errno = error;
      fail("cannot be read");
    }
  }
  return damaged ? Taken::kDamaged : Taken::kImage;
}

}  // namespace mms
