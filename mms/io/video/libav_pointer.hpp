#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace mms {

/// Frees objects of FFmpeg's libraries.
struct LibavDeleter {
  /// @{
  /// Frees the object, or closes the file.
  void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
  /// @}
};

/// Owns an object of FFmpeg's libraries.
template <class T>
using LibavPointer = std::unique_ptr<T, LibavDeleter>;

}  // namespace mms
