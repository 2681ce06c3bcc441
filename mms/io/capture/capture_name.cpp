#include "mms/io/capture/packet_capture.hpp"

namespace mms {

bool is_capture_name(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".pcap" || ending == ".pcapng" || ending == ".cap";
}

}  // namespace mms
