#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/io/journal/byte_reader.hpp"

namespace mms {

// Records of ROS 1 bags, version 2.0 (wiki.ros.org/Bags/Format/2.0): a header of named values and
// data, each preceded by its 32-bit length.

inline constexpr std::string_view kRos1Magic = "#ROSBAG V2.0\n";

/// Kinds of records.
enum class Ros1Op : char {
  kMessage = 0x02,
  kBagHeader = 0x03,
  kIndex = 0x04,
  kChunk = 0x05,
  kChunkInfo = 0x06,
  kConnection = 0x07,
};

/// Named values of a record or connection.
class Ros1Fields {
 public:
  /// @throws DataError if the bytes are damaged.
  explicit Ros1Fields(std::string_view bytes);

  /// The value; empty if it is missing.
  std::string_view text(std::string_view name) const;

  /// @throws DataError if there is no such number.
  template <class T>
  T number(std::string_view name) const {
    return ByteReader(text(name), "the value '" + std::string(name) + "' of a record").take<T>();
  }

  /// The kind of the record.
  /// @throws DataError if it has none.
  Ros1Op op() const { return number<Ros1Op>("op"); }

 private:
  std::vector<std::pair<std::string, std::string>> values_;
};

/// Seconds and nanoseconds of 32 bits each, as in bags.
Timestamp ros1_time(std::uint64_t bits);
std::uint64_t ros1_bits(Timestamp time);

}  // namespace mms
