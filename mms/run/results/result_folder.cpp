#include "mms/run/results/result_folder.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

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
                                         "outside_map",
                                         "pictures",
                                         "report.html",
                                         "run.json",
                                         "run.mcap",
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

}  // namespace

ResultFolder::ResultFolder(const fs::path& output, const std::string& data, bool overwrite)
    : path_(output.empty() ? default_folder(data) : output), default_place_(output.empty()) {
  take(overwrite);
}

void ResultFolder::take(bool overwrite) {
  lock_.emplace(path_);
  check_writable(path_);
  if (!overwrite) check_no_journal(path_);
  take_output_folder(path_, kResults, kMarks, overwrite);
}

ResultFolder::~ResultFolder() {
  if (!lock_->made()) return;
  std::error_code ignored;
  fs::remove(path_, ignored);  // fails on purpose if it is not empty
}

bool ResultFolder::restore() {
  if (lock_->holds(path_)) return false;
  constexpr int kAttempts = 9;
  const fs::path removed = path_;
  for (int i = 2;; ++i) {
    try {
      take(false);
      return true;
    } catch (const FileError&) {
      if (i > kAttempts) throw;
      path_ = fmt::format("{}_{}", removed.string(), i);
    }
  }
}

void ResultFolder::make_latest() const {
  if (!default_place_) return;
  const fs::path link = path_.parent_path() / "latest";
  std::error_code error;  // optional, for file systems without links
  if (fs::is_symlink(link, error)) fs::remove(link, error);
  fs::create_directory_symlink(path_.filename(), link, error);
}

}  // namespace mms
