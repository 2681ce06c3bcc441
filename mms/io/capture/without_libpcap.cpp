#include "mms/core/error.hpp"
#include "mms/io/capture/packet_capture.hpp"

// Replaces packet_capture.cpp if libpcap is missing.

namespace mms {

class PacketCapture::Impl {};

PacketCapture::PacketCapture(const std::filesystem::path& path) {
  throw FileError(path.string(), "is a capture, but mms was built without libpcap",
                  "install libpcap-dev, run cmake again and build");
}
PacketCapture::~PacketCapture() = default;
std::optional<Datagram> PacketCapture::next() {
  return std::nullopt;
}
bool PacketCapture::damaged() const {
  return false;
}
std::int64_t PacketCapture::position() const {
  return 0;
}
void PacketCapture::seek(std::int64_t) {}

}  // namespace mms
