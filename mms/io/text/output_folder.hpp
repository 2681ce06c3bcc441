#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace mms {

/// Makes a folder if there is none, and keeps other processes from writing to it until its
/// destruction or the end of this process. On file systems without locks it does not lock.
class FolderLock {
 public:
  /// @throws FileError if the folder cannot be made or opened, or is locked by another process.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Whether the folder was made.
  bool made() const { return made_; }

  /// Whether the path is still that of the locked folder, which may have been removed or replaced.
  bool holds(const std::filesystem::path& path) const;

 private:
  bool made_ = false;
  int descriptor_ = -1;
};

/// Whether `path` is what its name says: a folder if it has no ending, else a file; of links, what
/// they lead to.
bool is_as_named(const std::filesystem::path& path);

/// Makes an output folder, or takes one that has nothing but earlier outputs. Devices, links to
/// them, and what file systems keep of removed files (.nfs...) are left alone.
/// @param own        names of all files and folders that the caller writes there; those without
///                   ending are folders. Their temporary files, left by a killed process, are
///                   earlier outputs, too.
/// @param marks      those of them that only this program writes; without any, the rest is not ours
/// @param overwrite  removes earlier outputs
/// @returns whether the folder was created
/// @throws FileError if the folder has other files, or earlier outputs without `overwrite`; if it
/// cannot be created or read, or an output cannot be removed. Then no file was changed.
bool take_output_folder(const std::filesystem::path& folder, std::span<const std::string_view> own,
                        std::span<const std::string_view> marks, bool overwrite);

}  // namespace mms
