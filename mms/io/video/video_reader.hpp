#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/time.hpp"

namespace mms {

/// The color images of a video file (MP4, Matroska and the other containers of FFmpeg). Only the
/// current image is in memory. Not thread-safe.
class VideoReader {
 public:
  /// Reads the stamps of all images, but no image.
  /// @throws FileError if the file cannot be read, or the program was built without FFmpeg.
  /// @throws DataError if it is no video, or of a codec that cannot be decoded.
  explicit VideoReader(const std::filesystem::path& path);
  ~VideoReader();
  VideoReader(const VideoReader&) = delete;
  VideoReader& operator=(const VideoReader&) = delete;

  int width() const;   ///< [px]
  int height() const;  ///< [px]

  /// Presentation time of every image relative to the first one, ascending.
  const std::vector<Duration>& times() const;

  /// An image as it is stored: rotations for display are ignored. The next image is the fastest to
  /// read; others need those since the last key frame.
  /// @param index  below `times().size()`
  /// @throws DataError if it is damaged.
  Image<Rgb> read(std::size_t index);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a file name is that of a video.
bool is_video_name(const std::filesystem::path& path);

}  // namespace mms
