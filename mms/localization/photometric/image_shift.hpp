#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "mms/localization/features/feature_cloud.hpp"

namespace mms {

/// Rotations between two images by the shifts that correlate them best, searched exhaustively in
/// small images (as the relocalizer of PTAM: Klein and Murray, ECCV 2008). First guesses for turns
/// between frames that the last velocity does not predict. Roll is not estimated, and a translation
/// counts as a rotation.
/// @param before, now  a coarse level of both images
/// @param max_count    of rotations
/// @returns rotations that take directions of `now` to the sensor frame of `before`, the most
///          significant correlation first; none without enough static pixels
std::vector<Eigen::Matrix3d> rotations_by_shift(const IntensityLevel& before,
                                                const IntensityLevel& now, std::size_t max_count);

}  // namespace mms
