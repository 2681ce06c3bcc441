#include "mms/core/error.hpp"
#include "mms/io/video/video_reader.hpp"

// Replaces video_reader.cpp if FFmpeg's libraries are missing.

namespace mms {

class VideoReader::Impl {};

VideoReader::VideoReader(const std::filesystem::path& path) {
  throw FileError(path.string(), "is a video, but mms was built without FFmpeg",
                  "install libavformat-dev, libavcodec-dev and libswscale-dev, run cmake again and "
                  "build");
}
VideoReader::~VideoReader() = default;
int VideoReader::width() const {
  return 0;
}
int VideoReader::height() const {
  return 0;
}
const std::vector<Duration>& VideoReader::times() const {
  static const std::vector<Duration> kNone;
  return kNone;
}
Image<Rgb> VideoReader::read(std::size_t) {
  return {};
}

}  // namespace mms
