#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mms/io/text/output_folder.hpp"

namespace mms {

/// Output folder of a run, created before the run, so that a folder that cannot be used is detected
/// first. Only one process uses it at a time.
class ResultFolder {
 public:
  /// @param output     empty: `results/TIME_NAME` in the working directory
  /// @param overwrite  removes the results of an earlier run
  /// @throws FileError if the folder cannot be made or written to, has other files, has results
  /// without `overwrite`, or is in use.
  ResultFolder(const std::filesystem::path& output, const std::string& data, bool overwrite);

  /// Removes the folder if it was created for this run and is empty.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Makes the folder anew if it was removed or replaced since; under another name ("x_2") if the
  /// place is taken.
  /// @returns whether it was
  /// @throws FileError if none can be made.
  bool restore();

  /// Links results/latest to the folder, if it is in results/. Anything else of that name is kept.
  void make_latest() const;

 private:
  void take(bool overwrite);

  std::filesystem::path path_;
  bool default_place_ = false;
  std::optional<FolderLock> lock_;
};

}  // namespace mms
