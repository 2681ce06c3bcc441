#pragma once

#include <string>

#include "mms/core/segmentation.hpp"
#include "mms/ros/display_messages.hpp"

namespace mms {

/// Encodes the masks of an image for another host.
msg::Masks masks_message(const msg::Header& header, const Segmentation& segmentation);

/// Masks from another host, scaled to the image's size.
/// @throws DataError at `where` for an unknown class or a damaged mask.
Segmentation segmentation_of(const msg::Masks& message, int width, int height,
                             const std::string& where);

}  // namespace mms
