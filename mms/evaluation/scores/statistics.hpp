#pragma once

#include <span>

namespace mms {

/// The statistics below ignore NaN and infinite values and are NaN where nothing is left.

/// Percentile by nearest rank: the smallest value that at least `percent` % of the values do not
/// exceed; always one of the values, never between two. `percent` is clamped to [0, 100]; 0 gives
/// the minimum.
double percentile(std::span<const double> values, double percent);

/// Middle value, the mean of the two center ones for an even number.
double median(std::span<const double> values);

double mean(std::span<const double> values);

/// Root of the mean square.
double root_mean_square(std::span<const double> values);

double maximum(std::span<const double> values);

}  // namespace mms
