#include "mms/io/image_io.hpp"

#include "mms/io/files.hpp"
#include "mms/io/stb/stb_picture.hpp"

namespace mms {

Image<Rgb> read_color(const std::filesystem::path& path) {
  return decode_with_stb(read_file(path), path.string());
}

}  // namespace mms
