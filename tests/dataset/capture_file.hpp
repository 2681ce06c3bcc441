#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

#include "mms/core/time.hpp"

namespace mms::testing {

/// Appends the bytes of a number, the lowest first.
template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Replaces bytes by those of a number, the lowest first.
template <class T>
void put_at(std::string& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Writes a capture of UDP datagrams over Ethernet (.pcap with nanoseconds).
class CaptureFile {
 public:
  CaptureFile();

  /// Adds a datagram, in fragments if it is larger than packets of Ethernet.
  void add(const std::string& payload, Timestamp captured, std::uint16_t port);

  /// All bytes of the file so far.
  const std::string& bytes() const { return bytes_; }

 private:
  void add_packet(const std::string& ip_data, std::size_t offset, bool more, Timestamp captured);

  std::string bytes_;
  std::uint16_t datagram_ = 0;
};

}  // namespace mms::testing
