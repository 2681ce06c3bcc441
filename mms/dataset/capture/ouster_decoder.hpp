#pragma once

#include <memory>
#include <string>

#include "mms/dataset/capture/packet_decoder.hpp"
#include "mms/io/capture/ouster_metadata.hpp"

namespace mms {

/// Decoder for the packets of Ouster sensors: profiles LEGACY, RNG19_RFL8_SIG16_NIR16 (also _DUAL,
/// of which the first return is used) and RNG15_RFL8_NIR8.
/// @throws DataError at `where` for another profile.
std::unique_ptr<PacketDecoder> make_ouster_decoder(OusterMetadata metadata,
                                                   const std::string& where);

}  // namespace mms
