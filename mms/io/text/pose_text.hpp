#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// Parses `fields` as finite numbers.
/// @throws DataError at `where` with the first invalid one.
std::vector<double> parse_finite(std::span<const std::string_view> fields,
                                 const std::string& where);

/// Rigid transform of the 12 or 16 numbers of a 3x4 or 4x4 matrix, row-major, without
/// normalization.
/// @throws DataError at `where` for another count, if the 3x3 part is not a rotation (tolerance
/// 1e-3), or the fourth row is not 0 0 0 1.
Eigen::Isometry3d isometry_from_rows(std::span<const double> numbers, const std::string& where);

}  // namespace mms
