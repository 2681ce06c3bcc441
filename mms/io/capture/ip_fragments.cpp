#include "mms/io/capture/ip_fragments.hpp"

#include <algorithm>

namespace mms {
namespace {

constexpr std::size_t kIpHeader = 20;  // without options
constexpr std::size_t kUdpHeader = 8;
constexpr std::uint8_t kUdp = 17;
constexpr std::size_t kMaxPartial = 64;  // datagrams that wait for fragments
constexpr std::size_t kMaxDatagram = 65535;

std::uint8_t byte_of(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

std::uint32_t big_endian32(std::string_view bytes, std::size_t at) {
  return (std::uint32_t{big_endian16(bytes, at)} << 16) | big_endian16(bytes, at + 2);
}

std::optional<Datagram> parse_udp(std::string_view bytes, std::uint32_t source) {
  if (bytes.size() < kUdpHeader) return std::nullopt;
  const std::size_t size = big_endian16(bytes, 4);
  if (size < kUdpHeader || size > bytes.size()) return std::nullopt;
  Datagram datagram;
  datagram.source_address = source;
  datagram.destination_port = big_endian16(bytes, 2);
  datagram.payload = bytes.substr(kUdpHeader, size - kUdpHeader);
  return datagram;
}

}  // namespace

std::uint16_t big_endian16(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint16_t>((byte_of(bytes, at) << 8) | byte_of(bytes, at + 1));
}

std::optional<Datagram> IpFragments::add(std::string_view packet) {
  if (packet.size() < kIpHeader || byte_of(packet, 0) >> 4 != 4) return std::nullopt;
  const std::size_t header = 4 * std::size_t{byte_of(packet, 0) & 0x0FU};
  const std::size_t total = big_endian16(packet, 2);
  if (header < kIpHeader || total < header || total > packet.size()) return std::nullopt;
  if (byte_of(packet, 9) != kUdp) return std::nullopt;
  const std::uint32_t source = big_endian32(packet, 12);
  const std::string_view data = packet.substr(header, total - header);
  const std::uint16_t flags = big_endian16(packet, 6);
  const bool more = (flags & 0x2000) != 0;
  const std::size_t offset = 8 * std::size_t{flags & 0x1FFFU};
  if (!more && offset == 0) return parse_udp(data, source);
  if (offset + data.size() > kMaxDatagram) return std::nullopt;

  if (partial_.size() >= kMaxPartial) partial_.clear();
  const Key key(source, big_endian32(packet, 16), big_endian16(packet, 4));
  Partial& partial = partial_[key];
  partial.bytes.resize(std::max(partial.bytes.size(), offset + data.size()));
  std::copy(data.begin(), data.end(), partial.bytes.begin() + static_cast<std::ptrdiff_t>(offset));
  partial.received += data.size();
  if (!more) partial.size = offset + data.size();
  if (!partial.size || partial.received < *partial.size) return std::nullopt;
  complete_ = std::move(partial.bytes);
  partial_.erase(key);
  return parse_udp(complete_, source);
}

}  // namespace mms
