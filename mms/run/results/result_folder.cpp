#include "mms/run/results/result_folder.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <string_view>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/output_folder.hpp"

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

/// Everything that `mms run` and `mms reproduce` write into their folder.
constexpr std::string_view kResults[] = {"config.yaml",
                                         "frames.csv",
                                         "journal.bin",
                                         "keyframes.tum",
                                         "loops.csv",
                                         "map.bt",
                                         "map.pgm",
                                         "map.yaml",
                                         "metrics.json",
                                         "objects.json",
                                         "pictures",
                                         "report.html",
                                         "run.json",
                                         "static_map.pcd",
                                         "static_map.ply",
                                         "semantic_map.ply",
                                         "timing.csv",
                                         "trajectory.tum",
                                         "trajectory_map.tum",
                                         "truth.tum",
                                         "trajectory_kitti.txt",
                                         "reproduction.json",
                                         "still_none",
                                         "still_vision",
                                         "still_multimodal",
                                         "loop_none",
                                         "loop_multimodal"};

/// Those that no other program writes.
constexpr std::string_view kMarks[] = {"metrics.json", "run.json", "journal.bin",
                                       "reproduction.json"};

/// @throws FileError if the folder has the journal of a run that did not end.
void check_no_journal(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "journal.bin") || fs::exists(folder / "metrics.json")) return;
  throw FileError(folder.string(), "has the journal of a run that did not end",
                  "recover it with mms convert, or replace it with --overwrite");
}

void check_writable(const fs::path& folder) {
  if (access(folder.c_str(), W_OK | X_OK) == 0) return;
  throw FileError(folder.string(), "is not writable",
                  "choose another folder with -o or change its permissions");
}

/// Locks a folder for this process, until it ends or the descriptor is closed.
/// @returns the descriptor
int lock(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) throw FileError(folder.string(), "cannot be opened");
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const bool in_use = errno == EWOULDBLOCK;
  if (!in_use) return descriptor;  // a file system without locks
  close(descriptor);
  throw FileError(folder.string(), "is in use by another run", "choose another folder with -o");
}

}  // namespace

ResultFolder::ResultFolder(const fs::path& output, const std::string& data, bool overwrite)
    : path_(output.empty() ? default_folder(data) : output), default_place_(output.empty()) {
  made_ = make_folder(path_);
  check_writable(path_);
  lock_ = lock(path_);
  try {
    if (!overwrite) check_no_journal(path_);
    take_output_folder(path_, kResults, kMarks, overwrite);
  } catch (...) {
    close(lock_);
    throw;
  }
}

ResultFolder::~ResultFolder() {
  close(lock_);
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
