#include "mms/io/text/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;

namespace {

/// A device or pipe, as a link to /dev/null in place of a file that is not wanted.
bool is_special(const fs::path& path) {
  std::error_code error;
  return fs::is_other(path, error);
}

/// What is left of files that were removed while they were open, where a computer lost power or the
/// program was killed: of NFS, of FUSE, and of `DiskBuffer`.
bool is_remainder(const std::string& name) {
  return name.starts_with(".nfs") || name.starts_with(".fuse_hidden") || name.starts_with(".mms_");
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder)
    : made_(make_folder(folder)),
      descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) throw FileError(folder.string(), "cannot be opened");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw FileError(folder.string(), "is in use by another mms", "choose another folder with -o");
}

FolderLock::~FolderLock() {
  close(descriptor_);
}

bool FolderLock::holds(const fs::path& path) const {
  struct stat locked {};
  struct stat there {};
  return fstat(descriptor_, &locked) == 0 && stat(path.c_str(), &there) == 0 &&
         locked.st_dev == there.st_dev && locked.st_ino == there.st_ino;
}

bool is_as_named(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error) != path.has_extension();
}

bool take_output_folder(const fs::path& folder, std::span<const std::string_view> own,
                        std::span<const std::string_view> marks, bool overwrite) {
  const bool made = make_folder(folder);
  std::vector<std::string> names = list_folder(folder);
  std::erase_if(names, [&](const std::string& name) {
    return is_special(folder / name) || is_remainder(name);
  });
  const auto is_in = [](std::span<const std::string_view> list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const bool marked = std::any_of(names.begin(), names.end(),
                                  [&](const std::string& name) { return is_in(marks, name); });
  const auto others =
      std::stable_partition(names.begin(), names.end(), [&](const std::string& name) {
        return marked && is_in(own, name_without_temporary_part(name)) &&
               is_as_named(folder / name);
      });
  if (others != names.end()) {
    const auto count = names.end() - others;
    throw FileError(folder.string(),
                    "has " + (count == 1 ? "a file" : std::to_string(count) + " files") +
                        " that this command did not write, as " + *others,
                    "choose a new folder with -o");
  }
  if (!names.empty() && !overwrite) {
    throw FileError(folder.string(), "has earlier results, as " + names.front(),
                    "replace them with --overwrite, or choose a new folder with -o");
  }
  for (const std::string& name : names) {
    std::error_code error;
    fs::remove_all(folder / name, error);
    if (error) throw FileError((folder / name).string(), "cannot be removed: " + error.message());
  }
  return made;
}

}  // namespace mms
