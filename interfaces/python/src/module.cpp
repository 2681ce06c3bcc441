#include "interfaces/python/src/bindings.hpp"
#include "mms/core/error.hpp"

namespace py = pybind11;

namespace mms::python {

void warn(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    if (PyErr_WarnEx(PyExc_UserWarning, line.c_str(), 1) != 0) throw py::error_already_set();
  }
}

}  // namespace mms::python

PYBIND11_MODULE(_mms, module) {
  const auto error = py::register_exception<mms::Error>(module, "Error", PyExc_RuntimeError);
  py::register_exception<mms::DataError>(module, "DataError", error);
  py::register_exception<mms::ConfigError>(module, "ConfigError", error);
  py::register_exception<mms::FileError>(module, "FileError", error);
  module.attr("__version__") = MMS_VERSION;
  mms::python::bind_types(module);
  mms::python::bind_recording(module);
  mms::python::bind_slam(module);
  mms::python::bind_evaluation(module);
}
