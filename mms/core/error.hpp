#pragma once

#include <stdexcept>
#include <string>

namespace mms {

/// Error reported to the user in one line: where, what (with the value and the allowed range) and a
/// hint. Invalid frames are a `Status`, never an exception.
class Error : public std::runtime_error {
 public:
  /// @param where file, key or option
  /// @param what the fault, with the value and the allowed range
  /// @param hint how to correct it; may be empty
  Error(const std::string& where, const std::string& what, const std::string& hint = "")
      : std::runtime_error(where + ": " + what + (hint.empty() ? "" : " (" + hint + ")")) {}
};

/// A recording, image, scan or trajectory that cannot be read or is invalid.
class DataError : public Error {
 public:
  using Error::Error;
};

/// A configuration file with an unknown key, a wrong type or a value out of range.
class ConfigError : public Error {
 public:
  using Error::Error;
};

/// A file or folder that cannot be opened or written.
class FileError : public Error {
 public:
  using Error::Error;
};

}  // namespace mms
