#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "mms/core/trajectory.hpp"

// A trajectory is a class of its own in Python, not a list.
PYBIND11_MAKE_OPAQUE(mms::Trajectory);

namespace mms::python {

// Each adds its part of the module.
void bind_types(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_slam(pybind11::module_& module);
void bind_evaluation(pybind11::module_& module);

/// The result of `call()`, while other threads of Python run.
template <class Call>
auto without_lock(const Call& call) {
  const pybind11::gil_scoped_release release;
  return call();
}

/// Gives each line to Python's module `warnings`.
/// @throws error_already_set where its filters make an exception of one
void warn(const std::vector<std::string>& lines);

}  // namespace mms::python
