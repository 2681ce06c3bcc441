#pragma once

#include <cstdint>

#include "mms/segmentation/solo/network_config.hpp"

namespace mms {

/// Operations (two per multiply-add) of a network's convolutions for one image, without those of
/// the objects' masks.
/// @param width, height of the padded input [px], multiples of 32
std::int64_t network_operations(const NetworkConfig& config, int width, int height);

/// Number of parameters and statistics.
std::int64_t network_parameters(const NetworkConfig& config);

}  // namespace mms
