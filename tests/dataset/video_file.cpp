#include "tests/dataset/video_file.hpp"

#include <stdexcept>

#if MMS_WITH_LIBAV
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace mms::testing {
namespace {

constexpr AVRational kMilliseconds = {1, 1000};
constexpr int kDuration = 40;  // of an image [ms]

int checked(int code) {
  if (code < 0) throw std::runtime_error("the test's video cannot be written");
  return code;
}

class VideoFile {
 public:
  VideoFile(const std::filesystem::path& path, int width, int height, VideoCodec kind) {
    checked(avformat_alloc_output_context2(&format_, nullptr, nullptr, path.c_str()));
    const bool lossless = kind == VideoCodec::kLossless;
    const AVCodec* encoder = avcodec_find_encoder(lossless ? AV_CODEC_ID_FFV1 : AV_CODEC_ID_MPEG4);
    codec_ = avcodec_alloc_context3(encoder);
    codec_->width = width;
    codec_->height = height;
    codec_->time_base = kMilliseconds;
    codec_->pix_fmt = lossless ? AV_PIX_FMT_BGR0 : AV_PIX_FMT_YUV420P;
    if (!lossless) {
      codec_->gop_size = 5;
      codec_->max_b_frames = 2;
      codec_->bit_rate = 4'000'000;
    }
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) {
      codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    }
    checked(avcodec_open2(codec_, encoder, nullptr));
    stream_ = avformat_new_stream(format_, nullptr);
    stream_->time_base = kMilliseconds;
    checked(avcodec_parameters_from_context(stream_->codecpar, codec_));
    checked(avio_open(&format_->pb, path.c_str(), AVIO_FLAG_WRITE));
    checked(avformat_write_header(format_, nullptr));
    scaler_ = sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height, codec_->pix_fmt,
                             SWS_BILINEAR, nullptr, nullptr, nullptr);
    frame_ = av_frame_alloc();
    frame_->width = width;
    frame_->height = height;
    frame_->format = codec_->pix_fmt;
    checked(av_frame_get_buffer(frame_, 0));
    packet_ = av_packet_alloc();
  }

  ~VideoFile() {
    av_packet_free(&packet_);
    av_frame_free(&frame_);
    sws_freeContext(scaler_);
    avcodec_free_context(&codec_);
    avio_closep(&format_->pb);
    avformat_free_context(format_);
  }

  void add(const Image<Rgb>& image, std::int64_t time) {
    checked(av_frame_make_writable(frame_));
    const auto* pixels = reinterpret_cast<const std::uint8_t*>(image.pixels().data());
    const int stride = 3 * image.width();
    sws_scale(scaler_, &pixels, &stride, 0, image.height(), frame_->data, frame_->linesize);
    frame_->pts = time;
    write(frame_);
  }

  void finish() {
    write(nullptr);
    checked(av_write_trailer(format_));
  }

 private:
  void write(const AVFrame* frame) {
    checked(avcodec_send_frame(codec_, frame));
    while (avcodec_receive_packet(codec_, packet_) >= 0) {
      av_packet_rescale_ts(packet_, codec_->time_base, stream_->time_base);
      packet_->stream_index = stream_->index;
      packet_->duration = av_rescale_q(kDuration, kMilliseconds, stream_->time_base);
      checked(av_interleaved_write_frame(format_, packet_));
    }
  }

  AVFormatContext* format_ = nullptr;
  AVCodecContext* codec_ = nullptr;
  AVStream* stream_ = nullptr;
  SwsContext* scaler_ = nullptr;
  AVFrame* frame_ = nullptr;
  AVPacket* packet_ = nullptr;
};

}  // namespace

void write_video(const std::filesystem::path& path, const std::vector<Image<Rgb>>& images,
                 const std::vector<Duration>& times, VideoCodec codec) {
  std::filesystem::create_directories(path.parent_path());
  VideoFile file(path, images.at(0).width(), images[0].height(), codec);
  for (std::size_t i = 0; i < images.size(); ++i) file.add(images[i], times[i].count() / 1'000'000);
  file.finish();
}

}  // namespace mms::testing
#else
namespace mms::testing {

void write_video(const std::filesystem::path&, const std::vector<Image<Rgb>>&,
                 const std::vector<Duration>&, VideoCodec) {
  throw std::runtime_error("built without FFmpeg");
}

}  // namespace mms::testing
#endif
