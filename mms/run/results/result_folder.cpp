#include "mms/run/results/result_folder.hpp"

#include <fmt/chrono.h>

#include <ctime>
#include <fstream>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

std::string name_of(const std::string& data) {
  const fs::path path = fs::path(data).lexically_normal();
  std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  for (char& c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
    if (!plain) c = '_';
  }
  return name.empty() ? "run" : name;
}

/// results/<time>_<name>, with a counter for runs within one second.
fs::path default_folder(const std::string& data) {
  const std::string stem =
      fmt::format("{:%Y%m%d-%H%M%S}_{}", fmt::localtime(std::time(nullptr)), name_of(data));
  fs::path folder = fs::path("results") / stem;
  for (int i = 2; fs::exists(folder); ++i)
    folder = fs::path("results") / fmt::format("{}_{}", stem, i);
  return folder;
}

void check_writable(const fs::path& folder) {
  const fs::path probe = folder / ".writable";
  const bool written = static_cast<bool>(std::ofstream(probe) << "x" << std::flush);
  std::error_code ignored;
  fs::remove(probe, ignored);
  if (!written) {
    throw FileError(folder.string(), "is not writable",
                    "choose another folder with -o or change its permissions");
  }
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& output, const std::string& data)
    : path_(output.empty() ? default_folder(data) : output), default_place_(output.empty()) {
  made_ = make_folder(path_);
  check_writable(path_);
}

ResultFolder::~ResultFolder() {
  if (!made_) return;
  std::error_code ignored;
  fs::remove(path_, ignored);  // fails on purpose if it is not empty
}

void ResultFolder::make_latest() const {
  if (!default_place_) return;
  const fs::path link = path_.parent_path() / "latest";
  std::error_code error;  // optional, for file systems without links
  fs::remove(link, error);
  fs::create_directory_symlink(path_.filename(), link, error);
}

}  // namespace mms
