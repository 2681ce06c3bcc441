#include "mms/io/image/image_io.hpp"

#include "mms/io/stb/stb_picture.hpp"
#include "mms/io/text/files.hpp"

namespace mms {

Image<Rgb> read_color(const std::filesystem::path& path) {
  return decode_with_stb(read_file(path), path.string());
}

}  // namespace mms
