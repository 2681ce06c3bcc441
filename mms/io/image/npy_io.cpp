#include "mms/io/image/npy_io.hpp"

#include <cstdint>
#include <cstring>
#include <regex>
#include <string>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMaxHeader = 4096;  // bytes; NumPy writes about a hundred

/// Text of the header, a Python dictionary, and where the data begin (NumPy's format 1.0 to 3.0).
struct Header {
  std::string text;
  std::size_t data = 0;
};

Header read_header(const std::string& bytes, const fs::path& path) {
  constexpr std::size_t kVersion = 6;
  if (!bytes.starts_with(kMagic) || bytes.size() < kVersion + 6) {
    throw DataError(path.string(), "is not a NumPy file");
  }
  const auto byte = [&](std::size_t i) {
    return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
  };
  const bool is_short = byte(kVersion) == 1;
  const std::size_t begin = kVersion + 2 + (is_short ? 2 : 4);
  std::size_t size = byte(8) + (byte(9) << 8);
  if (!is_short) size += (byte(10) << 16) + (byte(11) << 24);
  if (size > kMaxHeader) throw DataError(path.string(), "has a damaged NumPy header");
  if (begin + size > bytes.size()) throw DataError(path.string(), "is truncated");
  return {bytes.substr(begin, size), begin + size};
}

/// The first group of a pattern in the header.
std::string field(const Header& header, const char* pattern, const fs::path& path) {
  std::smatch match;
  if (std::regex_search(header.text, match, std::regex(pattern))) return match[1];
  throw DataError(path.string(), "has another NumPy array",
                  "expected one of two dimensions in C order");
}

int side_of(const std::string& text, const fs::path& path) {
  const auto value = parse_integer(text);
  if (value && *value > 0 && *value <= kMaxImageSide) return static_cast<int>(*value);
  throw DataError(path.string(), "has a side of " + text + " px");
}

/// The pixels, stored as `From`.
template <class From, class To = From>
Image<To> convert(const std::string& bytes, std::size_t begin, int width, int height,
                  const fs::path& path) {
  const std::size_t size =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * sizeof(From);
  if (bytes.size() - begin != size) {
    throw DataError(path.string(), "has " + std::to_string(bytes.size() - begin) +
                                       " bytes of data, not " + std::to_string(size));
  }
  Image<To> image(width, height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    From value;
    std::memcpy(&value, bytes.data() + begin + i * sizeof(From), sizeof(From));
    image[i] = static_cast<To>(value);
  }
  return image;
}

}  // namespace

StoredDepth read_npy(const fs::path& path) {
  const std::string bytes = read_file(path);
  const Header header = read_header(bytes, path);
  field(header, R"('fortran_order': *(False))", path);
  const std::string type = field(header, R"('descr': *'([^']*)')", path);
  const int height = side_of(field(header, R"('shape': *\( *(\d+) *, *\d+ *,? *\))", path), path);
  const int width = side_of(field(header, R"('shape': *\( *\d+ *, *(\d+) *,? *\))", path), path);
  if (type == "<f4") return convert<float>(bytes, header.data, width, height, path);
  if (type == "<f8") return convert<double, float>(bytes, header.data, width, height, path);
  if (type == "<u2") return convert<std::uint16_t>(bytes, header.data, width, height, path);
  throw DataError(path.string(), "has numbers of type " + type, "expected <f4, <f8 or <u2");
}

}  // namespace mms
