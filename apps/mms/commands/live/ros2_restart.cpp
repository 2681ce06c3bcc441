#include "apps/mms/commands/live/ros2_restart.hpp"

#include <string_view>
#include <system_error>
#include <utility>

#include "mms/core/error.hpp"
#include "mms/map_file/map_file.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

/// The first name that is not taken of "x_2.ext", "x_3.ext" and so on.
fs::path numbered(fs::path path) {
  if (!path.has_filename()) path = path.parent_path();
  for (int number = 2;; ++number) {
    const std::string name = path.stem().string() + "_" + std::to_string(number);
    fs::path candidate = path.parent_path() / (name + path.extension().string());
    if (!fs::exists(candidate)) return candidate;
  }
}

fs::path path_of(std::string_view url) {
  constexpr std::string_view kScheme = "file://";
  if (url.starts_with(kScheme)) url.remove_prefix(kScheme.size());
  return url;
}

}  // namespace

TriggerResult Ros2Restart::reset() {
  if (requested_) return {false, "the run ends already"};
  requested_ = true;
  return {true, "the run ends and its results are written; the next one begins"};
}

msg::LoadMapReply Ros2Restart::load(const std::string& url) {
  using Reply = msg::LoadMapReply;
  const auto refuse = [this](Reply::Result result, const std::string& why) {
    report_("load_map: " + why);
    return Reply{{}, result};
  };
  if (requested_) return refuse(Reply::kUndefinedFailure, "the run ends already");
  if (!closes_loops_) return refuse(Reply::kUndefinedFailure, "needs loop closure, but it is off");
  const fs::path path = path_of(url);
  std::error_code fault;  // as for a name that is too long
  if (!fs::exists(path, fault)) {
    return refuse(Reply::kDoesNotExist, "'" + path.string() + "': no such file");
  }
  try {
    const MapFile file(path, MapFile::Mode::kRead);
  } catch (const Error& error) {
    return refuse(Reply::kInvalidData, error.what());
  }
  map_ = path;
  requested_ = true;
  return {{}, Reply::kSuccess};
}

RunOptions Ros2Restart::next(RunOptions first) const {
  if (!first.output.empty()) first.output = numbered(first.output);
  if (!first.save_map.empty()) first.save_map = numbered(first.save_map);
  if (map_) {
    first.map = *map_;
    first.localize = first.save_map.empty();
  }
  return first;
}

}  // namespace mms
