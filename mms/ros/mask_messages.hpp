#pragma once

#include <string>

#include "mms/core/segmentation.hpp"
#include "mms/ros/display_messages.hpp"

namespace mms {

/// The masks of an image for another host.
msg::Masks masks_message(const msg::Header& header, const Segmentation& segmentation);

/// The masks that came from another host, enlarged to the image's size.
/// @throws DataError at `where` for an unknown class or a mask that is damaged.
Segmentation segmentation_of(const msg::Masks& message, int width, int height,
                             const std::string& where);

}  // namespace mms
