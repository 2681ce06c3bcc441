#pragma once

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace mms {

/// A duration as "0:07", "12:30" or "2:05:00"; "-" if it is not finite.
inline std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "-";
  const auto whole = static_cast<std::int64_t>(std::lround(seconds));
  const std::int64_t minutes = whole / 60;
  if (minutes < 60) return fmt::format("{}:{:02}", minutes, whole % 60);
  return fmt::format("{}:{:02}:{:02}", minutes / 60, minutes % 60, whole % 60);
}

}  // namespace mms
