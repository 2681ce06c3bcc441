#pragma once

#include <pybind11/numpy.h>
#include <Eigen/Core>
#include <cstdint>

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/time.hpp"
#include "mms/core/transform.hpp"

namespace mms::python {

namespace py = pybind11;

/// Shape of an array that is expected; -1 stands for any number.
using Shape = std::vector<py::ssize_t>;

/// @throws value_error that names the argument if the array has another shape, or gaps
void check_layout(const py::array& array, const char* name, const Shape& shape);

/// @throws value_error that names the argument, the type that it has, and those that are allowed
[[noreturn]] void fail_type(const py::array& array, const char* name, const char* allowed);

/// The array without gaps: itself, or a copy.
inline py::array packed(const py::array& array) {
  return py::array::ensure(array, py::array::c_style);
}

/// The numbers of an array, without a copy.
/// @param type  name of T in numpy
/// @throws value_error if it has another type or shape, or gaps
template <class T>
const T* data_of(const py::array& array, const char* name, const char* type, const Shape& shape) {
  if (!py::isinstance<py::array_t<T>>(array)) fail_type(array, name, type);
  check_layout(array, name, shape);
  return static_cast<const T*>(array.data());
}

/// @{
/// Arrays on the memory of `owner`, which they keep alive.
template <class T>
py::array view(const std::vector<T>& values, const py::object& owner) {
  using Number = std::conditional_t<std::is_enum_v<T>, std::uint8_t, T>;
  static_assert(sizeof(Number) == sizeof(T));
  return py::array(py::dtype::of<Number>(), Shape{static_cast<py::ssize_t>(values.size())},
                   values.data(), owner);
}

inline py::array view(const std::vector<Eigen::Vector3f>& points, const py::object& owner) {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float));
  return py::array(py::dtype::of<float>(), Shape{static_cast<py::ssize_t>(points.size()), 3},
                   points.data(), owner);
}

inline py::array view(const std::vector<Rgb>& colors, const py::object& owner) {
  static_assert(sizeof(Rgb) == 3);
  return py::array(py::dtype::of<std::uint8_t>(), Shape{static_cast<py::ssize_t>(colors.size()), 3},
                   colors.data(), owner);
}

template <class T>
py::array view(const Image<T>& image, const py::object& owner) {
  Shape shape = {image.height(), image.width()};
  if constexpr (std::is_same_v<T, Rgb>) shape.push_back(3);
  return view(image.pixels(), owner).reshape(shape);
}
/// @}

/// An N x 3 float32 array as points.
/// @throws value_error as `data_of`
std::vector<Eigen::Vector3f> points_of(const py::array& array, const char* name);

/// An array of `count` float32 numbers; empty without one.
/// @throws value_error as `data_of`
std::vector<float> numbers_of(const std::optional<py::array>& array, const char* name,
                              py::ssize_t count);

/// A 4 x 4 matrix as a transform.
/// @throws value_error that names the argument if it is no rigid transform
Eigen::Isometry3d isometry_of(const Eigen::Matrix4d& matrix, const char* name);

template <class Target, class Source>
Eigen::Matrix4d matrix_of(const Transform<Target, Source>& transform) {
  return transform.isometry().matrix();
}

}  // namespace mms::python
