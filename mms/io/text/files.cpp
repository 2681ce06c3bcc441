#include "mms/io/text/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "mms/core/error.hpp"

namespace mms {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path, std::uint64_t limit) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw FileError(path.string(), "no such file");
  if (!fs::is_regular_file(status)) throw FileError(path.string(), "is not a regular file");

  const std::uint64_t size = fs::file_size(path, error);
  if (!error && size > limit) {
    throw FileError(
        path.string(),
        "has " + std::to_string(size) + " bytes, allowed: up to " + std::to_string(limit),
        "it may be a file of another kind");
  }
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(stream ? fs::file_size(path, error) : 0, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream || error) {
    throw FileError(path.string(), std::string("cannot be read: ") +
                                       (errno == 0 ? "it became shorter" : std::strerror(errno)));
  }
  return bytes;
}

std::vector<std::string> list_folder(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  std::vector<std::string> names;
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  if (error) throw FileError(folder.string(), "cannot list the folder: " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

bool make_folder(const fs::path& folder) {
  std::error_code error;
  const bool made = fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder)) return made;
  throw FileError(folder.string(),
                  "cannot create the folder: " + (error ? error.message() : "is a file"),
                  "choose another folder with -o");
}

}  // namespace mms
