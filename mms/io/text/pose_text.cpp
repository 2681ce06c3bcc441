#include "mms/io/text/pose_text.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {

std::vector<double> parse_finite(std::span<const std::string_view> fields,
                                 const std::string& where) {
  std::vector<double> numbers;
  for (const std::string_view field : fields) {
    const auto number = parse_double(field);
    if (!number || !std::isfinite(*number)) {
      throw DataError(where, "'" + std::string(field) + "' is not a finite number");
    }
    numbers.push_back(*number);
  }
  return numbers;
}

Eigen::Isometry3d isometry_from_rows(std::span<const double> numbers, const std::string& where) {
  if (numbers.size() != 12 && numbers.size() != 16) {
    throw DataError(where, std::to_string(numbers.size()) + " numbers are not a pose",
                    "expected 12 or 16, a 3x4 or 4x4 matrix, row-major");
  }
  using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const Rows rows = Eigen::Map<const Rows>(numbers.data());
  const Eigen::Matrix3d rotation = rows.leftCols<3>();
  constexpr double kTolerance = 1e-3;
  const double error = (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm();
  if (!(error < kTolerance) || rotation.determinant() < 0.0) {
    throw DataError(where, "the 3x3 part is not a rotation",
                    "off by " + format_number(error) + ", determinant " +
                        format_number(rotation.determinant()) + ", expected 1");
  }
  const double last_row[] = {0.0, 0.0, 0.0, 1.0};
  if (numbers.size() == 16 && !std::equal(last_row, last_row + 4, numbers.data() + 12)) {
    throw DataError(where, "the fourth row is not 0 0 0 1");
  }
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() = rotation;
  isometry.translation() = rows.col(3);
  return isometry;
}

}  // namespace mms
