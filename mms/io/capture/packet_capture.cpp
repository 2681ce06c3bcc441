#include "mms/io/capture/packet_capture.hpp"

#include <pcap/pcap.h>

#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/io/capture/ip_fragments.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::uint16_t kIpv4 = 0x0800;
constexpr std::uint16_t kVlan = 0x8100;

/// Bytes of a link's header before the IPv4 packet; nullopt for packets of other kinds.
std::optional<std::size_t> link_header(int link, std::string_view packet) {
  switch (link) {
    case DLT_EN10MB: {
      constexpr std::size_t kTag = 4;
      std::size_t type_at = 12;
      while (packet.size() > type_at + kTag && big_endian16(packet, type_at) == kVlan) {
        type_at += kTag;
      }
      if (packet.size() < type_at + 2 || big_endian16(packet, type_at) != kIpv4) return {};
      return type_at + 2;
    }
    case DLT_LINUX_SLL:
      if (packet.size() < 16 || big_endian16(packet, 14) != kIpv4) return {};
      return 16;
    case DLT_LINUX_SLL2:
      if (packet.size() < 20 || big_endian16(packet, 0) != kIpv4) return {};
      return 20;
    case DLT_NULL:
    case DLT_LOOP:
      return 4;
    default:  // DLT_RAW
      return 0;
  }
}

bool is_known_link(int link) {
  return link == DLT_EN10MB || link == DLT_LINUX_SLL || link == DLT_LINUX_SLL2 ||
         link == DLT_NULL || link == DLT_LOOP || link == DLT_RAW;
}

}  // namespace

class PacketCapture::Impl {
 public:
  explicit Impl(const fs::path& path) {
    if (!fs::is_regular_file(path)) throw FileError(path.string(), "no such file");
    char error[PCAP_ERRBUF_SIZE] = {};
    capture_ =
        pcap_open_offline_with_tstamp_precision(path.c_str(), PCAP_TSTAMP_PRECISION_NANO, error);
    if (capture_ == nullptr) throw DataError(path.string(), "is no capture that libpcap reads");
    if (is_known_link(pcap_datalink(capture_))) return;
    const int link = pcap_datalink(capture_);
    pcap_close(capture_);
    throw DataError(path.string(), "has packets of a link of type " + std::to_string(link),
                    "expected Ethernet");
  }
  ~Impl() { pcap_close(capture_); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  std::optional<Datagram> next() {
    pcap_pkthdr* header = nullptr;
    const u_char* bytes = nullptr;
    while (true) {
      const int code = pcap_next_ex(capture_, &header, &bytes);
      damaged_ = code == PCAP_ERROR;
      if (code < 0) return std::nullopt;
      if (code == 0 || header->caplen < header->len) continue;
      const std::string_view packet(reinterpret_cast<const char*>(bytes), header->caplen);
      const auto skipped = link_header(pcap_datalink(capture_), packet);
      if (!skipped || packet.size() < *skipped) continue;
      auto datagram = fragments_.add(packet.substr(*skipped));
      if (!datagram) continue;
      constexpr std::int64_t kSecond = 1'000'000'000;
      datagram->captured = Timestamp(kSecond * header->ts.tv_sec + header->ts.tv_usec);
      return datagram;
    }
  }

  bool damaged() const { return damaged_; }
  std::int64_t position() const { return std::ftell(pcap_file(capture_)); }
  void seek(std::int64_t position) {
    std::fseek(pcap_file(capture_), static_cast<long>(position), SEEK_SET);
    fragments_.clear();
  }

 private:
  pcap_t* capture_ = nullptr;
  IpFragments fragments_;
  bool damaged_ = false;
};

PacketCapture::PacketCapture(const fs::path& path) : impl_(std::make_unique<Impl>(path)) {}
PacketCapture::~PacketCapture() = default;
std::optional<Datagram> PacketCapture::next() {
  return impl_->next();
}
bool PacketCapture::damaged() const {
  return impl_->damaged();
}
std::int64_t PacketCapture::position() const {
  return impl_->position();
}
void PacketCapture::seek(std::int64_t position) {
  impl_->seek(position);
}

}  // namespace mms
