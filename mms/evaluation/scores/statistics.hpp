#pragma once

#include <cstdint>
#include <span>

namespace mms {

/// part / whole; NaN without a whole.
double ratio(std::int64_t part, std::int64_t whole);

/// These statistics ignore NaN and infinite values; they are NaN if no value is left.

/// Percentile by nearest rank: the smallest value that at least `percent` % of the values do not
/// exceed, without interpolation. `percent` is clamped to [0, 100]; 0 gives the minimum.
double percentile(std::span<const double> values, double percent);

/// Median; the mean of the two central values for an even number.
double median(std::span<const double> values);

double mean(std::span<const double> values);

/// Root of the mean square.
double root_mean_square(std::span<const double> values);

double maximum(std::span<const double> values);

}  // namespace mms
