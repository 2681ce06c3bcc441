#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

#include "mms/core/error.hpp"

namespace mms {

static_assert(std::endian::native == std::endian::little, "values are copied bytewise");

/// Appends a number, little-endian.
template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// Reads little-endian numbers from the front of untrusted bytes.
class ByteReader {
 public:
  /// @param bytes  have to outlive the reader
  /// @param where  for messages
  ByteReader(std::string_view bytes, std::string where) : bytes_(bytes), where_(std::move(where)) {}

  /// @throws DataError if fewer bytes are left.
  template <class T>
  T take() {
    T value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }

  /// The next `size` bytes.
  /// @throws DataError if fewer are left.
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) {
      throw DataError(where_, "ends " + std::to_string(size - bytes_.size()) + " bytes too early");
    }
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  /// Reads a 32-bit count of items of at least `bytes_each` bytes.
  /// @throws DataError if the remaining bytes cannot hold as many, so that the count is safe to
  /// allocate.
  std::uint32_t take_count(std::size_t bytes_each) {
    return checked_count(take<std::uint32_t>(), bytes_each);
  }

  /// `count`, if the remaining bytes can hold as many items of at least `bytes_each` bytes.
  /// @throws DataError otherwise.
  template <class Count>
  Count checked_count(Count count, std::size_t bytes_each) const {
    const std::size_t most = bytes_.size() / bytes_each;
    if (count <= most) return count;
    throw DataError(where_, "promises " + std::to_string(count) + " entries, but has space for " +
                                std::to_string(most));
  }

  std::size_t left() const { return bytes_.size(); }   ///< [B]
  const std::string& where() const { return where_; }  ///< for messages

 private:
  std::string_view bytes_;
  std::string where_;
};

}  // namespace mms
