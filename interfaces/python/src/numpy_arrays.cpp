#include "interfaces/python/src/numpy_arrays.hpp"

#include <cstring>

namespace mms::python {
namespace {

/// As Python writes it.
std::string text_of(const Shape& numbers) {
  std::string text;
  for (const py::ssize_t number : numbers) {
    text += (text.empty() ? "" : ", ") + std::to_string(number);
  }
  return "(" + text + (numbers.size() == 1 ? ",)" : ")");
}

/// With N for any number.
std::string expected_text(const Shape& shape) {
  std::string text = text_of(shape);
  const std::size_t any = text.find("-1");
  return any == std::string::npos ? text : text.replace(any, 2, "N");
}

bool matches(const py::array& array, const Shape& shape) {
  if (array.ndim() != static_cast<py::ssize_t>(shape.size())) return false;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    if (shape[i] >= 0 && array.shape(static_cast<py::ssize_t>(i)) != shape[i]) return false;
  }
  return true;
}

}  // namespace

void check_layout(const py::array& array, const char* name, const Shape& shape) {
  const std::string where(name);
  if (!matches(array, shape)) {
    const Shape found(array.shape(), array.shape() + array.ndim());
    throw py::value_error(where + ": has the shape " + text_of(found) +
                          ", allowed: " + expected_text(shape));
  }
  if ((array.flags() & py::array::c_style) != 0) return;
  const Shape strides(array.strides(), array.strides() + array.ndim());
  throw py::value_error(where + ": has the strides " + text_of(strides) +
                        ", allowed: rows one after another, without gaps "
                        "(numpy.ascontiguousarray makes such a copy)");
}

void fail_type(const py::array& array, const char* name, const char* allowed) {
  const auto type = py::str(array.dtype()).cast<std::string>();
  throw py::value_error(std::string(name) + ": has the type " + type + ", allowed: " + allowed);
}

std::vector<Eigen::Vector3f> points_of(const py::array& given, const char* name) {
  const py::array array = packed(given);
  const auto* data = data_of<float>(array, name, "float32", {-1, 3});
  std::vector<Eigen::Vector3f> points(static_cast<std::size_t>(array.shape(0)));
  if (points.empty()) return points;
  // Points have no gaps, see `view`.
  std::memcpy(static_cast<void*>(points.data()), data, sizeof(Eigen::Vector3f) * points.size());
  return points;
}

std::vector<float> numbers_of(const std::optional<py::array>& array, const char* name,
                              py::ssize_t count) {
  if (!array) return {};
  const py::array whole = packed(*array);
  const auto* data = data_of<float>(whole, name, "float32", {count});
  return {data, data + count};
}

Eigen::Isometry3d isometry_of(const Eigen::Matrix4d& matrix, const char* name) {
  constexpr double kTolerance = 1e-4;  // of numbers that were rounded for a file
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  const bool is_rigid =
      matrix.allFinite() && matrix.row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0) &&
      (rotation * rotation.transpose()).isIdentity(kTolerance) && rotation.determinant() > 0.0;
  if (is_rigid) return Eigen::Isometry3d(matrix);
  throw py::value_error(std::string(name) +
                        ": is no rigid transform, allowed: a rotation and a translation [m] above "
                        "the row 0 0 0 1");
}

}  // namespace mms::python
