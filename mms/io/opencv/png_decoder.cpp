#include "mms/io/opencv/png_decoder.hpp"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <vector>

namespace mms {
namespace {

/// What libpng fills. It jumps out of its functions on faults, over which no object may live.
struct PngDecoder {
  std::string_view left;
  png_structp png = nullptr;
  png_infop info = nullptr;
  cv::Mat pixels;
  std::vector<png_bytep> rows;

  ~PngDecoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

void take_png_bytes(png_structp png, png_bytep to, std::size_t size) {
  auto& left = static_cast<PngDecoder*>(png_get_io_ptr(png))->left;
  if (size > left.size()) png_error(png, "truncated");
  std::memcpy(to, left.data(), size);
  left.remove_prefix(size);
}

void end_decoding(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

int matrix_type(png_structp png, png_infop info) {
  const bool stored_color = (png_get_color_type(png, info) & PNG_COLOR_MASK_COLOR) != 0;
  const bool alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                     (stored_color && png_get_valid(png, info, PNG_INFO_tRNS) != 0);
  const int channels = alpha ? 4 : stored_color ? 3 : 1;
  return CV_MAKETYPE(png_get_bit_depth(png, info) == 16 ? CV_16U : CV_8U, channels);
}

/// The conversions of cv::imread.
void convert_to(int type, png_structp png, png_infop info) {
  const int stored = png_get_color_type(png, info);
  const bool stored_color = (stored & PNG_COLOR_MASK_COLOR) != 0;
  if (CV_MAT_DEPTH(type) == CV_8U && png_get_bit_depth(png, info) == 16) {
    png_set_strip_16(png);
  } else {
    png_set_swap(png);
  }
  CV_MAT_CN(type) < 4 ? png_set_strip_alpha(png) : png_set_tRNS_to_alpha(png);
  if (stored == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if (!stored_color && png_get_bit_depth(png, info) < 8) png_set_expand_gray_1_2_4_to_8(png);
  if (stored_color) {
    png_set_bgr(png);
  } else if (CV_MAT_CN(type) > 1) {
    png_set_gray_to_rgb(png);
  }
  png_set_interlace_handling(png);
}

bool decode(PngDecoder& decoder, bool color) {
  png_structp png = decoder.png;
  png_infop info = decoder.info;
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &decoder, take_png_bytes);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // no texts, profiles
  png_read_info(png, info);
  const int type = color ? CV_8UC3 : matrix_type(png, info);
  convert_to(type, png, info);
  png_read_update_info(png, info);
  decoder.pixels.create(static_cast<int>(png_get_image_height(png, info)),
                        static_cast<int>(png_get_image_width(png, info)), type);
  if (png_get_rowbytes(png, info) > decoder.pixels.step) return false;
  for (int y = 0; y < decoder.pixels.rows; ++y) decoder.rows.push_back(decoder.pixels.ptr(y));
  png_read_image(png, decoder.rows.data());
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

cv::Mat decode_png(std::string_view bytes, bool color) {
  PngDecoder decoder;
  decoder.left = bytes;
  decoder.png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, end_decoding, ignore_warning);
  if (decoder.png != nullptr) decoder.info = png_create_info_struct(decoder.png);
  if (decoder.info == nullptr || !decode(decoder, color)) return {};
  return decoder.pixels;
}

}  // namespace mms
