#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "mms/core/time.hpp"
#include "mms/io/journal/byte_reader.hpp"

namespace mms::msg {

/// Serialization of messages.
enum class WireFormat {
  kRos1,  ///< ROS 1: little-endian and unaligned
  kCdr,   ///< ROS 2: XCDR1 (OMG DDS-XTypes 1.3, 7.4.1) after an encapsulation header of 4 bytes, in
          ///< either byte order; numbers aligned to their size, strings end with a zero byte
};

// Both formats have consecutive fields; strings and lists are preceded by a 32-bit count. A message
// is a struct with template <class Self, class Archive> static void fields(Self& self, Archive&
// archive) that passes its fields to an archive in order; the archives are the classes here.

template <class T>
inline constexpr bool kIsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Bytes up to the next multiple of `size`, a power of two.
constexpr std::size_t padding(std::size_t position, std::size_t size) {
  return (size - position % size) % size;
}

/// Reads messages from untrusted bytes.
class WireReader {
 public:
  /// @param where  for messages
  /// @throws DataError if the encapsulation header is not that of XCDR1.
  WireReader(std::string_view bytes, const std::string& where, WireFormat format)
      : bytes_(bytes, where), ros1_(format == WireFormat::kRos1) {
    if (!ros1_) read_encapsulation();
    size_ = bytes_.left();
  }

  /// @throws DataError if the bytes end too early.
  template <class... Fields>
  void operator()(Fields&... fields) {
    (read(fields), ...);
  }

  bool is_ros1() const { return ros1_; }

 private:
  void read_encapsulation() {
    const std::string_view header = bytes_.take(4);  // the last two bytes are options without use
    big_endian_ = header[1] == 0;
    if (header[0] == 0 && (header[1] == 0 || header[1] == 1)) return;
    throw DataError(bytes_.where(), "has the CDR representation " +
                                        std::to_string(256 * static_cast<std::uint8_t>(header[0]) +
                                                       static_cast<std::uint8_t>(header[1])) +
                                        ", expected 0 or 1 (plain XCDR1)");
  }

  void align(std::size_t size) {
    if (!ros1_) bytes_.take(padding(size_ - bytes_.left(), size));
  }

  /// Count of items of at least `bytes_each` bytes.
  std::size_t take_count(std::size_t bytes_each) {
    std::uint32_t count = 0;
    read(count);
    return bytes_.checked_count(count, bytes_each);
  }

  template <class T>
  static void swap(T& value) {
    auto* raw = reinterpret_cast<std::uint8_t*>(&value);
    std::reverse(raw, raw + sizeof value);
  }

  template <class T>
  void read(T& value) {
    if constexpr (kIsNumber<T>) {
      align(sizeof value);
      value = bytes_.take<T>();
      if (big_endian_) swap(value);
    } else {
      T::fields(value, *this);
    }
  }
  void read(bool& value) { value = bytes_.take<std::uint8_t>() != 0; }
  void read(std::string& text) {
    text = bytes_.take(take_count(1));
    if (!ros1_ && text.ends_with('\0')) text.pop_back();
  }
  void read(Timestamp& stamp) {
    std::uint32_t seconds = 0;
    std::uint32_t nanoseconds = 0;
    (*this)(seconds, nanoseconds);
    stamp = Timestamp(seconds * kSecond + nanoseconds);
  }
  void read(Duration& duration) {
    std::int32_t seconds = 0;
    std::int32_t nanoseconds = 0;
    (*this)(seconds, nanoseconds);
    duration = Duration(seconds * kSecond + nanoseconds);
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  template <class T>
  void read(std::vector<T>& values) {
    if constexpr (kIsNumber<T>) {
      values.resize(take_count(sizeof(T)));
      if (values.empty()) return;  // which has no padding
      align(sizeof(T));
      const std::string_view raw = bytes_.take(values.size() * sizeof(T));
      std::memcpy(values.data(), raw.data(), raw.size());
      if (big_endian_ && sizeof(T) > 1) std::for_each(values.begin(), values.end(), swap<T>);
    } else {
      // Element by element: a wrong count must not allocate more memory than there are bytes.
      values.clear();
      const std::size_t count = take_count(1);
      while (values.size() < count) {
        if (values.size() == kMaxItems) {
          throw DataError(bytes_.where(),
                          "has a list of more than " + std::to_string(kMaxItems) + " items");
        }
        read(values.emplace_back());
      }
    }
  }

  /// Items of a list that are no numbers, as the fields of a cloud or transforms.
  static constexpr std::size_t kMaxItems = 100'000;
  static constexpr std::int64_t kSecond = 1'000'000'000;
  ByteReader bytes_;
  std::size_t size_ = 0;  ///< of the fields [B]
  bool ros1_;
  bool big_endian_ = false;
};

/// Writes messages to the sink `put(const void*, size)`, little-endian.
template <class Sink>
class WireWriter {
 public:
  WireWriter(Sink& sink, WireFormat format) : sink_(sink), ros1_(format == WireFormat::kRos1) {
    constexpr std::array<std::uint8_t, 4> kLittleEndian = {0, 1, 0, 0};
    if (!ros1_) sink_.put(kLittleEndian.data(), kLittleEndian.size());
  }

  /// @throws DataError for a stamp outside the range of ROS.
  template <class... Fields>
  void operator()(const Fields&... fields) {
    (write(fields), ...);
  }

  bool is_ros1() const { return ros1_; }

 private:
  void put(const void* bytes, std::size_t size) {
    sink_.put(bytes, size);
    size_ += size;
  }

  void align(std::size_t size) {
    constexpr std::array<std::uint8_t, 8> kZeros{};
    if (!ros1_) put(kZeros.data(), padding(size_, size));
  }

  template <class T>
  void write(const T& value) {
    if constexpr (kIsNumber<T>) {
      align(sizeof value);
      put(&value, sizeof value);
    } else {
      T::fields(value, *this);
    }
  }
  void write(bool value) { write(static_cast<std::uint8_t>(value)); }
  void write(const std::string& text) {
    const std::size_t size = text.size() + (ros1_ ? 0 : 1);  // c_str() has the zero byte
    write(static_cast<std::uint32_t>(size));
    put(text.c_str(), size);
  }
  void write(Timestamp stamp) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t seconds = stamp.nanoseconds() / kSecond;
    const std::int64_t last = ros1_ ? UINT32_MAX : INT32_MAX;
    if (stamp < Timestamp() || seconds > last) {
      throw DataError("stamp " + stamp.to_string(), " does not fit ROS time",
                      "its range is 0 to " + std::to_string(last) + " s");
    }
    write(static_cast<std::uint32_t>(seconds));
    write(static_cast<std::uint32_t>(stamp.nanoseconds() % kSecond));
  }
  void write(Duration duration) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    write(static_cast<std::int32_t>(duration.count() / kSecond));
    write(static_cast<std::int32_t>(duration.count() % kSecond));
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    for (const T& value : values) write(value);
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    if (values.empty()) return;
    if constexpr (kIsNumber<T>) {
      align(sizeof(T));
      put(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) write(value);
    }
  }

  Sink& sink_;
  std::size_t size_ = 0;  ///< of the fields written [B]
  bool ros1_;
};

/// Decodes the message in `bytes`.
/// @throws DataError at `where` if they end too early.
template <class Message>
Message decode(std::string_view bytes, const std::string& where,
               WireFormat format = WireFormat::kRos1) {
  Message message;
  WireReader reader(bytes, where, format);
  reader(message);
  return message;
}

/// Encoded size of a message [bytes].
template <class Message>
std::size_t encoded_size(const Message& message, WireFormat format = WireFormat::kRos1) {
  struct Counter {
    std::size_t size = 0;
    void put(const void*, std::size_t bytes) { size += bytes; }
  } counter;
  WireWriter<Counter> writer(counter, format);
  writer(message);
  return counter.size;
}

/// Writes a message to `encoded_size` bytes.
/// @throws DataError for a stamp outside the range of ROS.
template <class Message>
void encode(const Message& message, std::uint8_t* bytes, WireFormat format = WireFormat::kRos1) {
  struct Memory {
    std::uint8_t* next;
    void put(const void* raw, std::size_t size) {
      if (size > 0) std::memcpy(next, raw, size);
      next += size;
    }
  } memory{bytes};
  WireWriter<Memory> writer(memory, format);
  writer(message);
}

}  // namespace mms::msg
