#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/capture/packet_decoder.hpp"
#include "mms/io/capture/packet_capture.hpp"

namespace mms {

/// A sensor in a capture.
struct CaptureSensor {
  std::unique_ptr<PacketDecoder> decoder;
  std::uint32_t address = 0;       ///< that sends its packets
  std::uint16_t port = 0;          ///< that receives them
  std::vector<std::string> facts;  ///< lines for `describe`

  /// Whether a datagram is a data packet of this sensor.
  bool sent(const Datagram& datagram) const {
    return datagram.source_address == address && datagram.destination_port == port &&
           decoder->is_data(datagram.payload);
  }
};

/// Finds the first sensor whose data packets are at the beginning of a capture. Beside NAME.pcap
/// may be the metadata of an Ouster in NAME.json, or the only .json there, and the corrections of
/// an HDL-64E in NAME.yaml.
/// @throws DataError with the sizes of the packets if there is none; ConfigError for invalid
/// corrections.
CaptureSensor find_capture_sensor(PacketCapture& capture, const std::filesystem::path& path);

}  // namespace mms
