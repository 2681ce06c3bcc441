#include "mms/io/video/video_reader.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "mms/core/error.hpp"
#include "mms/core/size_text.hpp"
#include "mms/io/image/image_container.hpp"
#include "mms/io/video/libav_pointer.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

std::string error_text(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  return text;
}

LibavPointer<AVFormatContext> open_container(const fs::path& path) {
  av_log_set_level(AV_LOG_QUIET);  // faults are reported by our own errors
  if (!fs::is_regular_file(path)) throw FileError(path.string(), "no such file");
  AVFormatContext* format = nullptr;
  int code = avformat_open_input(&format, path.c_str(), nullptr, nullptr);
  LibavPointer<AVFormatContext> owner(format);
  if (code >= 0) code = avformat_find_stream_info(format, nullptr);
  if (code < 0) {
    throw DataError(path.string(), "cannot be read as a video: " + error_text(code),
                    "the file may be truncated");
  }
  return owner;
}

/// Time of presentation, or of decoding in containers without it.
std::int64_t time_of(const AVPacket& packet) {
  return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

}  // namespace

class VideoReader::Impl {
 public:
  explicit Impl(const fs::path& path)
      : path_(path.string()),
        format_(open_container(path)),
        packet_(av_packet_alloc()),
        frame_(av_frame_alloc()) {
    open_codec();
    read_times();
  }

  int width() const { return codec_->width; }
  int height() const { return codec_->height; }
  const std::vector<Duration>& times() const { return times_; }

  Image<Rgb> read(std::size_t index) {
    const std::int64_t target = stamps_[index];
    if (needs_seek(index)) seek(target);
    while (!reached(target)) {
      if (!decode_next()) fail(index);
    }
    if (*current_ > target) {
      // Some containers find a key frame after the wanted image.
      seek(stamps_.front());
      while (!reached(target)) {
        if (!decode_next()) fail(index);
      }
    }
    if (*current_ != target) fail(index);
    return to_rgb(index);
  }

 private:
  void open_codec() {
    const AVCodec* decoder = nullptr;
    stream_ = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &decoder, 0);
    if (stream_ < 0) throw DataError(path_, "has no images of a codec that can be decoded");
    const AVCodecParameters& parameters = *format_->streams[stream_]->codecpar;
    codec_.reset(avcodec_alloc_context3(decoder));
    int code = avcodec_parameters_to_context(codec_.get(), &parameters);
    check_pixels();
    if (code >= 0) code = avcodec_open2(codec_.get(), decoder, nullptr);
    if (code < 0) throw DataError(path_, "cannot be decoded: " + error_text(code));
    if (codec_->width < 1 || codec_->height < 1 || codec_->width > kMaxImageSide ||
        codec_->height > kMaxImageSide) {
      throw DataError(path_, "has images of " + size_text(codec_->width, codec_->height) +
                                 " pixels, allowed are 1 to " + std::to_string(kMaxImageSide));
    }
  }

  /// Also of images whose size changes later, which then cannot be decoded.
  void check_pixels() {
    const auto limit = static_cast<std::int64_t>(pixel_limit());
    codec_->max_pixels = limit;
    if (std::int64_t{codec_->width} * codec_->height <= limit) return;
    throw DataError(path_,
                    "has images of " + size_text(codec_->width, codec_->height) +
                        " pixels, allowed: up to " + std::to_string(limit) + " pixels",
                    "the environment variable MMS_MAX_IMAGE_PIXELS sets the limit");
  }

  void read_times() {
    while (av_read_frame(format_.get(), packet_.get()) >= 0) {
      const bool shown =
          packet_->stream_index == stream_ && (packet_->flags & AV_PKT_FLAG_DISCARD) == 0;
      if (shown && time_of(*packet_) != AV_NOPTS_VALUE) {
        stamps_.push_back(time_of(*packet_));
        if ((packet_->flags & AV_PKT_FLAG_KEY) != 0) key_stamps_.push_back(stamps_.back());
      }
      av_packet_unref(packet_.get());
    }
    if (stamps_.empty()) throw DataError(path_, "has no images with time stamps");
    std::sort(stamps_.begin(), stamps_.end());
    stamps_.erase(std::unique(stamps_.begin(), stamps_.end()), stamps_.end());
    std::sort(key_stamps_.begin(), key_stamps_.end());
    const AVRational nanoseconds = {1, 1'000'000'000};
    for (const std::int64_t stamp : stamps_) {
      times_.emplace_back(
          av_rescale_q(stamp - stamps_.front(), format_->streams[stream_]->time_base, nanoseconds));
    }
  }

  bool reached(std::int64_t target) const { return current_ && *current_ >= target; }

  /// Whether a key frame is nearer to the image than what was decoded last.
  bool needs_seek(std::size_t index) const {
    const std::int64_t target = stamps_[index];
    if (!current_ || *current_ > target) return true;
    const auto next = std::upper_bound(stamps_.begin(), stamps_.end(), *current_);
    if (next == stamps_.end()) return false;
    const auto key = std::upper_bound(key_stamps_.begin(), key_stamps_.end(), *next);
    return key != key_stamps_.end() && *key <= target;
  }

  void seek(std::int64_t target) {
    if (av_seek_frame(format_.get(), stream_, target, AVSEEK_FLAG_BACKWARD) < 0) {
      throw DataError(path_, "cannot be read from another place", "the file may be damaged");
    }
    avcodec_flush_buffers(codec_.get());
    current_.reset();
    draining_ = false;
  }

  /// @returns false at the end
  bool decode_next() {
    current_.reset();  // the frame is emptied also where none follows
    while (true) {
      const int code = avcodec_receive_frame(codec_.get(), frame_.get());
      if (code >= 0) {
        current_ = frame_->best_effort_timestamp;
        return true;
      }
      if (code == AVERROR_EOF || draining_) return false;
      send_packet();
    }
  }

  /// Damaged packets give no image; `read` notices.
  void send_packet() {
    if (av_read_frame(format_.get(), packet_.get()) < 0) {
      draining_ = true;
      avcodec_send_packet(codec_.get(), nullptr);
      return;
    }
    if (packet_->stream_index == stream_) avcodec_send_packet(codec_.get(), packet_.get());
    av_packet_unref(packet_.get());
  }

  Image<Rgb> to_rgb(std::size_t index) {
    if (frame_->width < 1 || frame_->height < 1) fail(index);
    const auto format = static_cast<AVPixelFormat>(frame_->format);
    Image<Rgb> image(frame_->width, frame_->height);
    scaler_.reset(sws_getCachedContext(scaler_.release(), image.width(), image.height(), format,
                                       image.width(), image.height(), AV_PIX_FMT_RGB24,
                                       SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INT,
                                       nullptr, nullptr, nullptr));
    if (!scaler_) fail(index);
    const int* matrix = sws_getCoefficients(frame_->colorspace);
    const int full_range = frame_->color_range == AVCOL_RANGE_JPEG ? 1 : 0;
    constexpr int kOne = 1 << 16;  // contrast and saturation are kept
    sws_setColorspaceDetails(scaler_.get(), matrix, full_range, matrix, 1, 0, kOne, kOne);
    std::uint8_t* rows[] = {reinterpret_cast<std::uint8_t*>(image.pixels().data())};
    const int strides[] = {3 * image.width()};
    sws_scale(scaler_.get(), frame_->data, frame_->linesize, 0, image.height(), rows, strides);
    return image;
  }

  [[noreturn]] void fail(std::size_t index) const {
    throw DataError(path_, "image " + std::to_string(index) + " cannot be decoded");
  }

  std::string path_;
  LibavPointer<AVFormatContext> format_;
  LibavPointer<AVCodecContext> codec_;
  LibavPointer<AVPacket> packet_;
  LibavPointer<AVFrame> frame_;
  LibavPointer<SwsContext> scaler_;
  int stream_ = 0;
  std::vector<std::int64_t> stamps_;      ///< of the images [time base of the stream]
  std::vector<std::int64_t> key_stamps_;  ///< of those that are decoded without others
  std::vector<Duration> times_;
  std::optional<std::int64_t> current_;  ///< stamp of the image in `frame_`
  bool draining_ = false;                ///< the decoder got the end of the file
};

VideoReader::VideoReader(const fs::path& path) : impl_(std::make_unique<Impl>(path)) {}
VideoReader::~VideoReader() = default;
int VideoReader::width() const {
  return impl_->width();
}
int VideoReader::height() const {
  return impl_->height();
}
const std::vector<Duration>& VideoReader::times() const {
  return impl_->times();
}
Image<Rgb> VideoReader::read(std::size_t index) {
  return impl_->read(index);
}

}  // namespace mms
