#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "mms/dataset/capture/packet_decoder.hpp"
#include "mms/io/capture/velodyne_calibration.hpp"

namespace mms {

/// Whether a datagram is a data packet of a Velodyne sensor with 12 blocks.
bool is_velodyne_packet(std::string_view packet);

/// Whether a data packet is of an HDL-64E, which has a calibration of its own.
bool is_hdl64_packet(std::string_view packet);

/// Decoder for VLP-16, Puck Hi-Res, HDL-32E, VLP-32C and HDL-64E by the formulas of their manuals:
/// the rotation angle of a point is interpolated between blocks by its firing time. Of two returns
/// the last one is used.
/// @param packet       the first data packet, which names the sensor
/// @param corrections  of an HDL-64E; else empty
/// @throws DataError at `where` for another sensor.
std::unique_ptr<PacketDecoder> make_velodyne_decoder(std::string_view packet,
                                                     std::vector<LaserCorrection> corrections,
                                                     const std::string& where);

}  // namespace mms
