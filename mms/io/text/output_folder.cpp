#include "mms/io/text/output_folder.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;

namespace {

/// A device or pipe, as a link to /dev/null in place of a file that is not wanted.
bool is_special(const fs::path& path) {
  std::error_code error;
  return fs::is_other(path, error);
}

}  // namespace

bool take_output_folder(const fs::path& folder, std::span<const std::string_view> own,
                        std::span<const std::string_view> marks, bool overwrite) {
  const bool made = make_folder(folder);
  std::vector<std::string> names = list_folder(folder);
  std::erase_if(names, [&](const std::string& name) { return is_special(folder / name); });
  const auto is_in = [](std::span<const std::string_view> list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const bool marked = std::any_of(names.begin(), names.end(),
                                  [&](const std::string& name) { return is_in(marks, name); });
  const auto others =
      std::stable_partition(names.begin(), names.end(),
                            [&](const std::string& name) { return marked && is_in(own, name); });
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
