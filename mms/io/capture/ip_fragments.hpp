#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "mms/io/capture/packet_capture.hpp"

namespace mms {

/// A number of two bytes, the higher one first.
/// @param at  at most `bytes.size() - 2`
std::uint16_t big_endian16(std::string_view bytes, std::size_t at);

/// Puts UDP datagrams together whose IPv4 packets were fragmented (RFC 791): those of Ouster are
/// larger than packets of Ethernet.
class IpFragments {
 public:
  /// @param packet  an IPv4 packet
  /// @returns the datagram it completes, without time, valid until the next call; nullopt for
  /// none, and for other protocols
  std::optional<Datagram> add(std::string_view packet);

  /// Forgets all fragments.
  void clear() { partial_.clear(); }

 private:
  struct Partial {
    std::string bytes;
    std::size_t received = 0;
    std::optional<std::size_t> size;  ///< known from the last fragment
  };
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint16_t>;  ///< source, destination, id

  std::map<Key, Partial> partial_;
  std::string complete_;
};

}  // namespace mms
