#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "mms/io/text/numbers.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {

/// [s]: images further apart have stamps in another unit. Source: a map needs images that overlap.
inline constexpr double kLongestImageStep = 10.0;
/// [s]: the same of motion sensors. Source: the slowest wheels are read a few times a second.
inline constexpr double kLongestMotionStep = 1.0;

/// Whether numbers are nanoseconds since a sensor was turned on, which look like seconds, milli- or
/// microseconds since 1970: as those they would be further apart than `longest_step` [s] or no
/// stamps at all, as nanoseconds 1 ms to 1 s.
/// @param numbers  in any order; less than three prove nothing
bool are_nanoseconds_since_start(std::vector<std::int64_t> numbers, double longest_step);

/// Reads the stamps of one list, whose unit follows from all of them together.
class StampReader {
 public:
  /// @param table         with a stamp in each line
  /// @param column        of the stamps; shorter lines are passed over
  /// @param longest_step  [s]: stamps further apart have another unit
  StampReader(const TextTable& table, std::size_t column, double longest_step);

  /// As `parse_stamp`, or nanoseconds since a sensor was turned on.
  std::optional<Timestamp> operator()(std::string_view text) const;

 private:
  bool since_start_ = false;
};

}  // namespace mms
