#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mms {

/// `fields` as finite numbers. @throws DataError at `where` naming the first that is none.
std::vector<double> parse_finite(std::span<const std::string_view> fields,
                                 const std::string& where);

/// Rigid transform from the 12 or 16 numbers of a 3x4 or 4x4 matrix, row by row, kept as they are.
/// @throws DataError at `where` when the count is another, the 3x3 part is no rotation (1e-3), or
///         the fourth row is not 0 0 0 1.
Eigen::Isometry3d isometry_from_rows(std::span<const double> numbers, const std::string& where);

}  // namespace mms
