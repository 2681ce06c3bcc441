#pragma once

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/geometry/depth_noise.hpp"
#include "mms/global_map/keyframes/keyframe_record.hpp"

namespace mms {

/// ORB keypoints (Rublee et al., ICCV 2011) of the static part of an image, spread over it, where
/// the surface is continuous.
/// @param color  image of the frame
/// @param cloud  organized; its grid covers the image
/// @returns none for an empty image
ImageKeypoints extract_keypoints(const Image<Rgb>& color, const LabeledCloud& cloud,
                                 const DepthNoise& noise);

}  // namespace mms
