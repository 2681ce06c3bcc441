#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mms {

struct PlayCommand {};
struct PauseCommand {};
struct StepCommand {
  int by = 1;  ///< frames; negative: backward
};
struct SeekCommand {
  std::size_t frame = 0;
};
struct SpeedCommand {
  double value = 1.0;
};
/// Selects what the viewer receives; absent fields are unchanged.
struct WantCommand {
  std::optional<bool> points;
  std::optional<bool> image;
  std::optional<bool> map;
  std::optional<std::size_t> budget;  ///< largest number of map points
};
struct FocusCommand {
  Eigen::Vector3f point = Eigen::Vector3f::Zero();  ///< world frame [m]
};

using Command = std::variant<PlayCommand, PauseCommand, StepCommand, SeekCommand, SpeedCommand,
                             WantCommand, FocusCommand>;

inline constexpr std::size_t kMaxCommandBytes = 4096;
inline constexpr double kMinSpeed = 0.1;
inline constexpr double kMaxSpeed = 20.0;

/// Parses a viewer's command from JSON.
/// @throws DataError with the fault.
Command parse_command(std::string_view text);

}  // namespace mms
