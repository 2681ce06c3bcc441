#pragma once

#include <vector>

#include "mms/dataset/source/image_list.hpp"
#include "mms/dataset/source/rgbd_source.hpp"

namespace mms {

/// Adds a frame for each color image that has a depth image within 0.02 s, in order of stamps, and
/// facts.
/// @throws DataError if no two match.
void add_matched_frames(RgbdRecording& recording, const std::vector<ListedImage>& color,
                        const std::vector<ListedImage>& depth);

/// Adds a frame; its name is that of the color image.
void add_frame(RgbdRecording& recording, const ListedImage& color, const ListedImage& depth);

/// Sorts the frames by stamp, with a fact if they were not in order. Stamps of more than 1000
/// frames a second are no times: these frames keep their order, with a warning.
void sort_by_stamp(RgbdRecording& recording);

}  // namespace mms
