#include "mms/evaluation/scores/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace mms {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sorted_finite(std::span<const double> values) {
  std::vector<double> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  std::sort(finite.begin(), finite.end());
  return finite;
}

}  // namespace

double ratio(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : kNaN;
}

double percentile(std::span<const double> values, double percent) {
  const std::vector<double> sorted = sorted_finite(values);
  if (sorted.empty()) return kNaN;
  // Division last: 7 % of 100 is exactly 7, 0.07 * 100 is not.
  const double product = std::clamp(percent, 0.0, 100.0) * static_cast<double>(sorted.size());
  const double rank = std::ceil(product / 100.0);
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double median(std::span<const double> values) {
  const std::vector<double> sorted = sorted_finite(values);
  if (sorted.empty()) return kNaN;
  const std::size_t center = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[center] : 0.5 * (sorted[center - 1] + sorted[center]);
}

double mean(std::span<const double> values) {
  const std::vector<double> sorted = sorted_finite(values);
  if (sorted.empty()) return kNaN;
  return std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size());
}

double root_mean_square(std::span<const double> values) {
  const std::vector<double> sorted = sorted_finite(values);
  if (sorted.empty()) return kNaN;
  const double sum = std::inner_product(sorted.begin(), sorted.end(), sorted.begin(), 0.0);
  return std::sqrt(sum / static_cast<double>(sorted.size()));
}

double maximum(std::span<const double> values) {
  const std::vector<double> sorted = sorted_finite(values);
  return sorted.empty() ? kNaN : sorted.back();
}

}  // namespace mms
