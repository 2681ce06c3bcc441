#include "mms/io/stb/stb_picture.hpp"

#include <cstring>
#include <memory>

#include "mms/core/error.hpp"
#include "mms/io/image/image_container.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#include <stb_image.h>

namespace mms {

Image<Rgb> decode_with_stb(std::string_view bytes, const std::string& where) {
  check_whole_image(bytes, where);
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                            static_cast<int>(bytes.size()), &width, &height, &channels, 3),
      &stbi_image_free);
  if (!pixels) throw DataError(where, "is a damaged image that cannot be decoded");
  Image<Rgb> image(width, height);
  static_assert(sizeof(Rgb) == 3, "pixels are copied bytewise");
  std::memcpy(image.pixels().data(), pixels.get(), sizeof(Rgb) * image.size());
  return image;
}

}  // namespace mms
