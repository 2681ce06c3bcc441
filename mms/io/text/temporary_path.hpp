#pragma once

#include <filesystem>
#include <string>

namespace mms {

/// Digits that no other process has, for the names of temporary files. Containers and machines that
/// share a folder have processes of equal numbers, so these do not suffice.
std::string process_mark();

/// A temporary file, or a temporary folder of such files, that is removed at the end of its
/// lifetime, and by `remove_temporary_paths` where a signal ends the program.
class TemporaryPath {
 public:
  /// Registers the path; the caller makes the file.
  explicit TemporaryPath(std::filesystem::path path);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }  ///< as given

  /// Leaves the file to its new owner, as after it was renamed.
  void release();

 private:
  std::filesystem::path path_;
  char* registered_ = nullptr;
};

/// Removes the files and then the empty folders of all `TemporaryPath`s. For handlers of signals
/// that end the program: it neither allocates nor locks.
void remove_temporary_paths() noexcept;

}  // namespace mms
