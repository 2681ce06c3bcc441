#pragma once

#include <filesystem>
#include <string>

namespace mms {

/// The folder a run writes to. Made before the run, so that one that cannot be written to costs no
/// time.
class ResultFolder {
 public:
  /// @param output  empty: `results/TIME_NAME` in the working directory
  /// @throws FileError when the folder cannot be made or written to.
  ResultFolder(const std::filesystem::path& output, const std::string& data);

  /// Removes the folder if it was made for a run that left nothing in it.
  ~ResultFolder();
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Lets results/latest point to the folder, if it is one of results/.
  void make_latest() const;

 private:
  std::filesystem::path path_;
  bool default_place_ = false;
  bool made_ = false;
};

}  // namespace mms
