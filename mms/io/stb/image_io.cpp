#include "mms/io/image/image_io.hpp"

#include "mms/io/stb/stb_picture.hpp"
#include "mms/io/text/files.hpp"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace mms {
namespace {

void append(void* context, void* data, int size) {
  auto& bytes = *static_cast<std::vector<std::uint8_t>*>(context);
  const auto* first = static_cast<const std::uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image<Rgb>& image) {
  std::vector<std::uint8_t> bytes;
  stbi_write_png_to_func(append, &bytes, image.width(), image.height(), sizeof(Rgb),
                         image.pixels().data(), image.width() * static_cast<int>(sizeof(Rgb)));
  return bytes;
}

std::vector<std::uint8_t> encode_jpeg(const Image<Rgb>& image, int quality) {
  std::vector<std::uint8_t> bytes;
  stbi_write_jpg_to_func(append, &bytes, image.width(), image.height(), sizeof(Rgb),
                         image.pixels().data(), quality);
  return bytes;
}

Image<Rgb> read_color(const std::filesystem::path& path) {
  return decode_with_stb(read_file(path), path.string());
}

}  // namespace mms
