#include "mms/io/journal/crc32.hpp"

#include <array>
#include <cstring>

namespace mms {
namespace {

/// Bytes at a time ("slicing by 8", Kounavis and Berry, 2008).
constexpr std::size_t kSlices = 8;

/// Checksums of each byte followed by 0 to 7 zero bytes.
using Tables = std::array<std::array<std::uint32_t, 256>, kSlices>;

constexpr Tables make_tables() {
  constexpr std::uint32_t kReversedPolynomial = 0xEDB88320U;
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) {
      value = (value >> 1) ^ ((value & 1U) != 0 ? kReversedPolynomial : 0U);
    }
    tables[0][byte] = value;
  }
  for (std::size_t slice = 1; slice < kSlices; ++slice) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t value = tables[slice - 1][byte];
      tables[slice][byte] = (value >> 8) ^ tables[0][value & 0xFFU];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

}  // namespace

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t value = ~0U;
  for (; bytes.size() >= kSlices; bytes.remove_prefix(kSlices)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), kSlices);
    word ^= value;
    value = 0;
    for (std::size_t i = 0; i < kSlices; ++i) {
      value ^= kTables[kSlices - 1 - i][(word >> (8 * i)) & 0xFFU];
    }
  }
  for (const char c : bytes) {
    value = (value >> 8) ^ kTables[0][(value ^ static_cast<std::uint8_t>(c)) & 0xFFU];
  }
  return ~value;
}

}  // namespace mms
