#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "mms/ros2/map_messages.hpp"
#include "mms/ros2/ros2_node.hpp"
#include "mms/run/record/run_options.hpp"

namespace mms {

/// Answers the services ~/reset and ~/load_map: the run ends, and the next one begins with an empty
/// map, or in the map of a file.
class Ros2Restart {
 public:
  using Report = std::function<void(const std::string& message)>;

  /// @param closes_loops  whether the runs can localize in a map
  /// @param report        receives why a map is refused, in the node's thread
  Ros2Restart(bool closes_loops, Report report)
      : closes_loops_(closes_loops), report_(std::move(report)) {}

  // In the node's thread:

  TriggerResult reset();

  /// @param url  a path, or file:// before it
  msg::LoadMapReply load(const std::string& url);

  // In any thread:

  /// Whether the run should end, since another one was asked for.
  bool is_requested() const { return requested_; }

  /// Options of the next run: those of the first one, with results and map beside the earlier ones,
  /// as "x_2". After `is_requested`.
  RunOptions next(RunOptions first) const;

 private:
  bool closes_loops_;
  Report report_;
  std::optional<std::filesystem::path> map_;  ///< of the next run; none: that of the first one
  std::atomic<bool> requested_ = false;       ///< set after `map_`
};

}  // namespace mms
