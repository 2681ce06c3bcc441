// A library for LD_PRELOAD that acts as the kernel's driver of a depth camera, for tests:
// /dev/video0 gives depth, /dev/video1 only metadata, /dev/video2 colors. Variables:
//   MMS_TEST_V4L2         folder with camera.txt ("depth WIDTH HEIGHT FORMAT" and the same of
//                         "color"), stamps.txt [us] and the bytes of each image in depth/N and
//                         color/N; without it there is no camera
//   MMS_TEST_V4L2_PERIOD  between two images [ms], by default 33
//   MMS_TEST_V4L2_FAULT   "busy", "permission", "no depth", "no bandwidth", "silent", or "damaged":
//                         color image 3 is marked as damaged, image 5 is cut off, 7 is lost
// After the last image it is unplugged. A silent one stays plugged in instead.

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/videodev2.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kBuffers = 4;
constexpr std::size_t kPage = 4096;
constexpr int kMetadataNode = 1;
constexpr std::size_t kMarkedImage = 3;
constexpr std::size_t kCutImage = 5;
constexpr std::size_t kLostImage = 7;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

bool has_fault(const char* fault) {
  return variable("MMS_TEST_V4L2_FAULT") == fault;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

int fail(int error) {
  errno = error;
  return -1;
}

class Node {
 public:
  Node(int number, int file) : number_(number), file_(file) {
    std::ifstream camera(folder() + "/camera.txt");
    std::string name, format;
    while (camera >> name >> width_ >> height_ >> format) {
      if (name != what()) continue;
      format.resize(4, ' ');
      format_ = v4l2_fourcc(format[0], format[1], format[2], format[3]);
      break;
    }
    std::ifstream stamps(folder() + "/stamps.txt");
    stamps_.assign(std::istream_iterator<long>(stamps), {});
  }

  int control(unsigned long request, void* argument) {
    switch (request) {
      case VIDIOC_QUERYCAP:
        return describe(*static_cast<v4l2_capability*>(argument));
      case VIDIOC_ENUM_FMT: {
        auto& format = *static_cast<v4l2_fmtdesc*>(argument);
        if (format.index > 0 || !gives_images()) return fail(EINVAL);
        format.pixelformat = format_;
        return 0;
      }
      case VIDIOC_ENUM_FRAMESIZES: {
        auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
        if (size.index > 0) return fail(EINVAL);
        size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        size.discrete = {width_, height_};
        return 0;
      }
      case VIDIOC_ENUM_FRAMEINTERVALS: {
        auto& interval = *static_cast<v4l2_frmivalenum*>(argument);
        constexpr std::uint32_t kRates[] = {60, 30};
        if (interval.index >= std::size(kRates)) return fail(EINVAL);
        interval.type = V4L2_FRMIVAL_TYPE_DISCRETE;
        interval.discrete = {1, kRates[interval.index]};
        return 0;
      }
      case VIDIOC_S_FMT:
        return set(static_cast<v4l2_format*>(argument)->fmt.pix);
      case VIDIOC_S_PARM:
        return 0;
      case VIDIOC_REQBUFS:
        static_cast<v4l2_requestbuffers*>(argument)->count = kBuffers;
        return ftruncate(file_, static_cast<off_t>(kBuffers * length()));
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = static_cast<std::uint32_t>(length());
        buffer.m.offset = static_cast<std::uint32_t>(buffer.index * length());
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        return give(*static_cast<v4l2_buffer*>(argument));
      case VIDIOC_STREAMON:
        if (has_fault("no bandwidth")) return fail(ENOSPC);
        next_ = Clock::now();
        return 0;
      case VIDIOC_STREAMOFF:
        return 0;
      default:
        return fail(ENOTTY);
    }
  }

  bool is_unplugged() const {
    return image_ >= stamps_.size() && Clock::now() >= next_ && !has_fault("silent");
  }
  bool is_ready() const {
    return image_ < stamps_.size() && !queued_.empty() && Clock::now() >= next_;
  }

 private:
  static std::string folder() { return variable("MMS_TEST_V4L2"); }
  const char* what() const { return number_ == 0 ? "depth" : "color"; }
  bool gives_images() const {
    return number_ != kMetadataNode && !(number_ == 0 && has_fault("no depth"));
  }
  std::size_t pitch() const { return (2 * width_ + 63) / 64 * 64; }
  std::size_t length() const { return (pitch() * height_ + kPage - 1) / kPage * kPage; }

  int describe(v4l2_capability& capability) const {
    const auto write = [](auto& target, const char* text) {
      std::strncpy(reinterpret_cast<char*>(target), text, sizeof target - 1);
    };
    write(capability.card, "MMS-SLAM V4L2 camera");
    write(capability.bus_info, "usb-0000:00:14.0-2");
    capability.capabilities = V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    capability.device_caps =
        V4L2_CAP_STREAMING |
        (number_ == kMetadataNode ? V4L2_CAP_META_CAPTURE : V4L2_CAP_VIDEO_CAPTURE);
    return 0;
  }

  int set(v4l2_pix_format& pixels) const {
    if (has_fault("busy")) return fail(EBUSY);
    pixels.width = width_;
    pixels.height = height_;
    pixels.pixelformat = format_;
    pixels.bytesperline = static_cast<std::uint32_t>(pitch());
    return 0;
  }

  int give(v4l2_buffer& buffer) {
    if (is_unplugged()) return fail(ENODEV);
    if (!is_ready()) return fail(EAGAIN);
    const bool damaged = has_fault("damaged") && number_ != 0;
    if (damaged && image_ == kLostImage) end_image();
    const bool raw = format_ != V4L2_PIX_FMT_MJPEG;
    const std::string bytes = bytes_of(folder() + "/" + what() + "/" + std::to_string(image_));
    const std::size_t row = raw ? 2 * width_ : bytes.size();
    buffer.index = queued_.front();
    queued_.pop_front();
    std::size_t used = 0;
    for (std::size_t i = 0; i < bytes.size(); i += row, used += raw ? pitch() : row) {
      const auto place = static_cast<off_t>(buffer.index * length() + used);
      if (pwrite(file_, bytes.data() + i, row, place) < 0) return -1;
    }
    buffer.bytesused = static_cast<std::uint32_t>(damaged && image_ == kCutImage ? used / 3 : used);
    buffer.sequence = static_cast<std::uint32_t>(image_);
    buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    if (damaged && image_ == kMarkedImage) buffer.flags |= V4L2_BUF_FLAG_ERROR;
    buffer.timestamp = {stamps_[image_] / 1'000'000, stamps_[image_] % 1'000'000};
    end_image();
    return 0;
  }

  void end_image() {
    const std::string period = variable("MMS_TEST_V4L2_PERIOD");
    next_ += std::chrono::milliseconds(period.empty() ? 33 : std::stol(period));
    ++image_;
  }

  int number_;
  int file_;
  std::uint32_t width_ = 0, height_ = 0, format_ = 0;
  std::vector<long> stamps_;
  std::deque<std::uint32_t> queued_;
  std::size_t image_ = 0;
  Clock::time_point next_;
};

/// Streams of the library call some of these functions, too.
std::recursive_mutex& guard() {
  static std::recursive_mutex mutex;
  return mutex;
}

std::map<int, Node>& nodes() {
  static std::map<int, Node> map;
  return map;
}

int open_with(const char* name, const char* path, int flags, mode_t mode) {
  constexpr char kNode[] = "/dev/video";
  if (std::strncmp(path, kNode, sizeof kNode - 1) != 0) {
    return next<int (*)(const char*, int, mode_t)>(name)(path, flags, mode);
  }
  const int number = std::atoi(path + sizeof kNode - 1);
  if (number > 2 || variable("MMS_TEST_V4L2").empty()) return fail(ENOENT);
  if (has_fault("permission")) return fail(EACCES);
  const int file = memfd_create("camera", MFD_CLOEXEC);
  const std::scoped_lock lock(guard());
  nodes().insert_or_assign(file, Node(number, file));
  return file;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  return open_with("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  return open_with("open64", path, flags, mode);
}

int ioctl(int file, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  {
    const std::scoped_lock lock(guard());
    const auto node = nodes().find(file);
    if (node != nodes().end()) return node->second.control(request, argument);
  }
  return next<int (*)(int, unsigned long, void*)>("ioctl")(file, request, argument);
}

int close(int file) {
  {
    const std::scoped_lock lock(guard());
    nodes().erase(file);
  }
  return next<int (*)(int)>("close")(file);
}

int poll(pollfd* files, nfds_t count, int timeout) {
  const auto is_of_camera = [&] {
    const std::scoped_lock lock(guard());
    return count > 0 && nodes().contains(files[0].fd);
  };
  if (!is_of_camera()) {
    return next<int (*)(pollfd*, nfds_t, int)>("poll")(files, count, timeout);
  }
  const auto end = Clock::now() + std::chrono::milliseconds(timeout);
  do {
    int ready = 0;
    {
      const std::scoped_lock lock(guard());
      for (nfds_t i = 0; i < count; ++i) {
        const Node& node = nodes().at(files[i].fd);
        const int events = node.is_unplugged() ? POLLERR | POLLHUP : node.is_ready() ? POLLIN : 0;
        files[i].revents = static_cast<short>(events);
        if (events != 0) ++ready;
      }
    }
    if (ready > 0) return ready;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (Clock::now() < end);
  return 0;
}

}  // extern "C"
