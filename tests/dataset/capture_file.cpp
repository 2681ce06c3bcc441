#include "tests/dataset/capture_file.hpp"

#include <algorithm>

namespace mms::testing {
namespace {

constexpr std::size_t kFragment = 1480;  // bytes of a packet of Ethernet after its IP header

void put_big16(std::string& bytes, std::size_t value) {
  bytes += static_cast<char>((value >> 8) & 0xFF);
  bytes += static_cast<char>(value & 0xFF);
}

}  // namespace

CaptureFile::CaptureFile() {
  put<std::uint32_t>(bytes_, 0xA1B23C4D);  // times have nanoseconds
  put<std::uint16_t>(bytes_, 2);
  put<std::uint16_t>(bytes_, 4);
  put<std::uint64_t>(bytes_, 0);
  put<std::uint32_t>(bytes_, 65535);
  put<std::uint32_t>(bytes_, 1);  // Ethernet
}

void CaptureFile::add(const std::string& payload, Timestamp captured, std::uint16_t port) {
  std::string data;
  put_big16(data, 7000);
  put_big16(data, port);
  put_big16(data, 8 + payload.size());
  put_big16(data, 0);  // no checksum
  data += payload;
  for (std::size_t at = 0; at < data.size(); at += kFragment) {
    add_packet(data.substr(at, kFragment), at, at + kFragment < data.size(), captured);
  }
  ++datagram_;
}

void CaptureFile::add_packet(const std::string& ip_data, std::size_t offset, bool more,
                             Timestamp captured) {
  std::string packet(12, '\1');  // addresses of Ethernet
  put_big16(packet, 0x0800);
  packet += '\x45';
  packet += '\0';
  put_big16(packet, 20 + ip_data.size());
  put_big16(packet, datagram_);
  put_big16(packet, (more ? 0x2000U : 0U) | (offset / 8));
  packet += '\x40';
  packet += '\x11';  // UDP
  put_big16(packet, 0);
  packet += std::string("\xC0\xA8\x01\xC9\xFF\xFF\xFF\xFF", 8);
  packet += ip_data;
  put(bytes_, static_cast<std::uint32_t>(captured.nanoseconds() / 1'000'000'000));
  put(bytes_, static_cast<std::uint32_t>(captured.nanoseconds() % 1'000'000'000));
  put(bytes_, static_cast<std::uint32_t>(packet.size()));
  put(bytes_, static_cast<std::uint32_t>(packet.size()));
  bytes_ += packet;
}

}  // namespace mms::testing
