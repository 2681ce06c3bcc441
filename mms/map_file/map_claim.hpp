#pragma once

#include <filesystem>

namespace mms {

/// The right of one map of this process to write a file. A process that has a lock of a file loses
/// it where it opens and closes the file another time (POSIX), so all others ask first.
class MapClaim {
 public:
  /// @param path  of the map; need not exist
  /// @throws FileError if another map of this process has the right
  explicit MapClaim(const std::filesystem::path& path);
  ~MapClaim();
  MapClaim(const MapClaim&) = delete;
  MapClaim& operator=(const MapClaim&) = delete;

  /// Whether a map of this process has the right to write a file.
  static bool exists(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
};

}  // namespace mms
