#pragma once

#include "mms/dataset/source/rgbd_source.hpp"

namespace mms {

/// Adds the images in rgb/ and depth/ of a recording without lists, and facts: matched by the
/// stamps that are their names, in seconds, or by the numbers in their names (`find_series`).
/// @throws FileError if a folder cannot be read; DataError if the names have neither.
void add_unlisted_frames(RgbdRecording& recording);

}  // namespace mms
