#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>

#include "mms/core/time.hpp"

namespace mms {

/// A UDP datagram of IPv4.
struct Datagram {
  Timestamp captured;                  ///< by the recording computer
  std::uint32_t source_address = 0;    ///< IPv4, first byte highest
  std::uint16_t destination_port = 0;  ///< UDP
  std::string_view payload;            ///< without headers
};

/// A capture of network packets (.pcap, .pcapng). Only the current datagram is in memory. Fragments
/// are put together. Not thread-safe.
class PacketCapture {
 public:
  /// @throws FileError if the file cannot be read, or the program was built without libpcap.
  /// @throws DataError if it is no capture, or one of links without IPv4.
  explicit PacketCapture(const std::filesystem::path& path);
  ~PacketCapture();
  PacketCapture(const PacketCapture&) = delete;
  PacketCapture& operator=(const PacketCapture&) = delete;

  /// The next complete datagram, valid until the next call; nullopt at the end of the file or where
  /// it is damaged.
  std::optional<Datagram> next();

  /// Whether `next` ended at damage, as in a truncated file.
  bool damaged() const;

  /// Place in the file at which `next` continues [bytes].
  std::int64_t position() const;
  /// Continues at a place that `position` returned.
  void seek(std::int64_t position);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a file name is that of a capture.
bool is_capture_name(const std::filesystem::path& path);

}  // namespace mms
