#include <cstring>

#include "interfaces/python/src/bindings.hpp"
#include "mms/core/error.hpp"

namespace py = pybind11;

namespace mms::python {
namespace {

/// Names of files and damaged text need not be UTF-8: other bytes become \xNN.
py::str readable(const char* text) {
  PyObject* const result =
      PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(std::strlen(text)), "backslashreplace");
  if (result == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(result);
}

/// As py::register_exception, with readable messages.
template <class Fault>
py::object add_exception(py::module_& module, const char* name, const py::handle& base) {
  static PyObject* type = nullptr;
  type = py::exception<Fault>(module, name, base).release().ptr();
  py::register_exception_translator([](std::exception_ptr fault) {
    try {
      if (fault) std::rethrow_exception(fault);
    } catch (const Fault& error) {
      PyErr_SetObject(type, readable(error.what()).ptr());
    }
  });
  return py::reinterpret_borrow<py::object>(type);
}

}  // namespace

void warn(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    const auto text = readable(line.c_str()).cast<std::string>();
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
  }
}

/// The base first: the translator that was registered last is tried first.
void bind_errors(py::module_& module) {
  const py::object error = add_exception<Error>(module, "Error", PyExc_RuntimeError);
  add_exception<DataError>(module, "DataError", error);
  add_exception<ConfigError>(module, "ConfigError", error);
  add_exception<FileError>(module, "FileError", error);
}

}  // namespace mms::python

PYBIND11_MODULE(_mms, module) {
  mms::python::bind_errors(module);
  module.attr("__version__") = MMS_VERSION;
  mms::python::bind_types(module);
  mms::python::bind_recording(module);
  mms::python::bind_slam(module);
  mms::python::bind_evaluation(module);
}
