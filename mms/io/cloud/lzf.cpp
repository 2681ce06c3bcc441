#include "mms/io/cloud/lzf.hpp"

#include <cstdint>

namespace mms {
namespace {

/// Takes bytes from the front of the data; after their end there are none.
class Bytes {
 public:
  explicit Bytes(std::string_view data) : data_(data) {}
  bool empty() const { return data_.empty(); }

  std::optional<std::size_t> next() {
    if (data_.empty()) return std::nullopt;
    const auto byte = static_cast<std::uint8_t>(data_.front());
    data_.remove_prefix(1);
    return byte;
  }

  std::optional<std::string_view> next(std::size_t count) {
    if (data_.size() < count) return std::nullopt;
    const std::string_view taken = data_.substr(0, count);
    data_.remove_prefix(count);
    return taken;
  }

 private:
  std::string_view data_;
};

}  // namespace

std::optional<std::string> decompress_lzf(std::string_view data, std::size_t size) {
  constexpr std::size_t kLiteral = 32;   // smaller control bytes: that many literals follow, plus 1
  constexpr std::size_t kLongMatch = 7;  // a length in the control byte that another byte extends
  constexpr std::size_t kShortest = 2;   // added to the length of every match
  constexpr std::size_t kLongest = kLongMatch + 255 + kShortest;
  if (size / kLongest > data.size()) return std::nullopt;  // before allocation
  std::string result;
  result.reserve(size);
  Bytes bytes(data);
  while (!bytes.empty()) {
    const std::size_t control = *bytes.next();
    if (control < kLiteral) {
      const auto literals = bytes.next(control + 1);
      if (!literals || literals->size() > size - result.size()) return std::nullopt;
      result += *literals;
      continue;
    }
    std::size_t length = control >> 5;
    if (length == kLongMatch) {
      const auto more = bytes.next();
      if (!more) return std::nullopt;
      length += *more;
    }
    length += kShortest;
    const auto low = bytes.next();
    if (!low) return std::nullopt;
    const std::size_t distance = ((control & 0x1F) << 8 | *low) + 1;
    if (distance > result.size() || length > size - result.size()) return std::nullopt;
    const std::size_t from = result.size() - distance;
    for (std::size_t i = 0; i < length; ++i) result += result[from + i];  // they may overlap
  }
  if (result.size() != size) return std::nullopt;
  return result;
}

}  // namespace mms
