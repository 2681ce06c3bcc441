#pragma once

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

// ROS 1's wire format: consecutive fields, little-endian and unaligned; strings and lists are
// preceded by a 32-bit count. A message is a struct with template <class Self, class Archive>
// static void fields(Self& self, Archive& archive) that passes its fields to an archive in order;
// the archives are the three classes here.

template <class T>
inline constexpr bool kIsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// Reads messages from untrusted bytes.
class WireReader {
 public:
  /// @param where  for messages
  WireReader(std::string_view bytes, const std::string& where) : bytes_(bytes, where) {}

  /// @throws DataError if the bytes end too early.
  template <class... Fields>
  void operator()(Fields&... fields) {
    (read(fields), ...);
  }

 private:
  template <class T>
  void read(T& value) {
    if constexpr (kIsNumber<T>) {
      value = bytes_.take<T>();
    } else {
      T::fields(value, *this);
    }
  }
  void read(bool& value) { value = bytes_.take<std::uint8_t>() != 0; }
  void read(std::string& text) { text = bytes_.take(bytes_.take_count(1)); }
  void read(Timestamp& stamp) {
    const auto seconds = bytes_.take<std::uint32_t>();
    stamp = Timestamp(seconds * kSecond + bytes_.take<std::uint32_t>());
  }
  void read(Duration& duration) {
    const auto seconds = bytes_.take<std::int32_t>();
    duration = Duration(seconds * kSecond + bytes_.take<std::int32_t>());
  }
  template <class T, std::size_t N>
  void read(std::array<T, N>& values) {
    for (T& value : values) read(value);
  }
  template <class T>
  void read(std::vector<T>& values) {
    if constexpr (kIsNumber<T>) {
      values.resize(bytes_.take_count(sizeof(T)));
      const std::string_view raw = bytes_.take(values.size() * sizeof(T));
      if (!raw.empty()) std::memcpy(values.data(), raw.data(), raw.size());
    } else {
      // Element by element: a wrong count must not allocate more memory than there are bytes.
      values.clear();
      const std::size_t count = bytes_.take_count(1);
      while (values.size() < count) read(values.emplace_back());
    }
  }

  static constexpr std::int64_t kSecond = 1'000'000'000;
  ByteReader bytes_;
};

/// Writes messages to the sink `put(const void*, size)`.
template <class Sink>
class WireWriter {
 public:
  explicit WireWriter(Sink& sink) : sink_(sink) {}

  /// @throws DataError for a stamp outside the range of ROS.
  template <class... Fields>
  void operator()(const Fields&... fields) {
    (write(fields), ...);
  }

 private:
  template <class T>
  void write(const T& value) {
    if constexpr (kIsNumber<T>) {
      sink_.put(&value, sizeof value);
    } else {
      T::fields(value, *this);
    }
  }
  void write(bool value) { write(static_cast<std::uint8_t>(value)); }
  void write(const std::string& text) {
    write(static_cast<std::uint32_t>(text.size()));
    sink_.put(text.data(), text.size());
  }
  void write(Timestamp stamp) {
    constexpr std::int64_t kSecond = 1'000'000'000;
    const std::int64_t seconds = stamp.nanoseconds() / kSecond;
    if (stamp < Timestamp() || seconds > UINT32_MAX) {
      throw DataError("stamp " + stamp.to_string(), " does not fit ROS time",
                      "its range is 0 to 4294967295 s");
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
    if constexpr (kIsNumber<T>) {
      sink_.put(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) write(value);
    }
  }

  Sink& sink_;
};

/// Decodes the message in `bytes`.
/// @throws DataError at `where` if they end too early.
template <class Message>
Message decode(std::string_view bytes, const std::string& where) {
  Message message;
  WireReader reader(bytes, where);
  reader(message);
  return message;
}

/// Encoded size of a message [bytes].
template <class Message>
std::size_t encoded_size(const Message& message) {
  struct Counter {
    std::size_t size = 0;
    void put(const void*, std::size_t bytes) { size += bytes; }
  } counter;
  WireWriter<Counter> writer(counter);
  writer(message);
  return counter.size;
}

/// Writes a message to `encoded_size` bytes.
/// @throws DataError for a stamp outside the range of ROS.
template <class Message>
void encode(const Message& message, std::uint8_t* bytes) {
  struct Memory {
    std::uint8_t* next;
    void put(const void* raw, std::size_t size) {
      if (size > 0) std::memcpy(next, raw, size);
      next += size;
    }
  } memory{bytes};
  WireWriter<Memory> writer(memory);
  writer(message);
}

}  // namespace mms::msg
