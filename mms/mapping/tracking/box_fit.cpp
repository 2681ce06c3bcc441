#include "mms/mapping/tracking/box_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

constexpr double kTrim = 0.02;          // share of the points beyond either end that may be stray
constexpr double kUprightTrim = 0.005;  // the same upwards, where a head is few points
constexpr double kFacing = 0.25;        // sine of the angle at which a face is seen well
constexpr double kRightness = 0.3;      // cosine at which an end is at the image's left or right
constexpr double kMuchOfIt = 0.8;       // share of a size, below which a part is missing
constexpr double kSidePoint = 0.02;     // distance to a rectangle's side that counts as on it [m]
constexpr double kFloorError = 0.2;     // of its height [m]
constexpr double kHiddenBelow = 1.2;    // of what stands on the floor [m]
constexpr int kHeadingSteps = 45;       // over a quarter of a turn
constexpr std::size_t kHeadingPoints = 100;  // that a heading is found from

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

Interval trimmed_interval(std::vector<double>& values, double trim) {
  const auto truncation = static_cast<std::ptrdiff_t>(trim * static_cast<double>(values.size()));
  const auto low = values.begin() + truncation;
  const auto high = values.end() - 1 - truncation;
  std::nth_element(values.begin(), low, values.end());
  const double low_value = *low;
  std::nth_element(values.begin(), high, values.end());
  return {low_value, *high};
}

Interval interval_along(const ObjectMeasurement& object, const Eigen::Vector3d& axis, double trim) {
  std::vector<double> values;
  values.reserve(object.points.size());
  for (const Eigen::Vector3d& point : object.points) values.push_back(axis.dot(point));
  return trimmed_interval(values, trim);
}

/// Whether each end of an axis is in view.
struct Ends {
  bool low = true;
  bool high = true;
};

/// The ends that neither border nor occluder truncations off.
Ends visible_ends(const ObjectMeasurement& object, const Eigen::Vector3d& axis, bool upright) {
  if (upright) return {!object.truncation.bottom, !object.truncation.top};
  const double rightness = axis.dot(object.right);
  if (std::abs(rightness) < kRightness) return {};
  const bool left = !object.truncation.left;
  const bool right = !object.truncation.right;
  return rightness > 0.0 ? Ends{left, right} : Ends{right, left};
}

/// The ends that the object itself does not hide: both where the sensor faces a side along the
/// axis, else the nearer one.
Ends unhidden_ends(double sensor_along, const Interval& along, bool side_in_view) {
  if (side_in_view) return {};
  const double center = 0.5 * (along.low + along.high);
  return sensor_along < center ? Ends{true, false} : Ends{false, true};
}

/// The end that lies nearer to where it is expected.
Ends nearer_end(const Interval& seen, double expected, double size) {
  const double low_off = std::abs(seen.low - (expected - 0.5 * size));
  const double high_off = std::abs(seen.high - (expected + 0.5 * size));
  return low_off < high_off ? Ends{true, false} : Ends{false, true};
}

double center_of(const Interval& seen, const Ends& ends, double size) {
  if (ends.low == ends.high) return 0.5 * (seen.low + seen.high);
  return ends.low ? seen.low + 0.5 * size : seen.high - 0.5 * size;
}

/// Whether what was seen of something reaches, seen or not, down to the floor.
bool stands_on(const std::optional<double>& floor, const Interval& seen) {
  return floor && seen.low > *floor - kFloorError && seen.low < *floor + kHiddenBelow &&
         seen.high > *floor;
}

}  // namespace

BoxFit fit_box(const ObjectMeasurement& object, const GroundFrame& ground, double heading,
               const Eigen::Vector3d& size, const std::optional<Eigen::Vector3d>& expected) {
  const Eigen::Matrix3d axes = ground.axes(heading);
  const Eigen::Vector3d view = ground.horizontal(object.centroid - object.sensor).normalized();
  BoxFit fit;
  Eigen::Vector3d center;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = axes.col(k);
    const bool upright = k == 2;
    Interval seen = interval_along(object, axis, upright ? kUprightTrim : kTrim);
    const bool stands = upright && stands_on(ground.floor(), seen);
    if (stands) seen.low = *ground.floor();
    // A horizontal axis runs along the face that looks along the other one.
    const bool side_in_view = upright || std::abs(view.dot(axes.col(1 - k))) > kFacing;
    Ends uncut = visible_ends(object, axis, upright);
    uncut.low = uncut.low || stands;
    const Ends unhidden = unhidden_ends(axis.dot(object.sensor), seen, side_in_view);
    Ends ends = {uncut.low && unhidden.low, uncut.high && unhidden.high};
    // More than the size known was seen: nothing is hidden.
    if (seen.high - seen.low >= size[k]) ends = {};
    const bool both = ends.low && ends.high;
    if (both && expected && !stands && seen.high - seen.low < kMuchOfIt * size[k]) {
      ends = nearer_end(seen, axis.dot(*expected), size[k]);
    }
    const auto i = static_cast<std::size_t>(k);
    fit.whole[i] = uncut.low && uncut.high && side_in_view;
    fit.anchored = fit.anchored && (ends.low || ends.high);
    fit.extent[k] = seen.high - seen.low;
    center[k] = center_of(seen, ends, size[k]);
  }
  fit.center = axes * center;
  return fit;
}

double rectangle_heading(const ObjectMeasurement& object, const GroundFrame& ground) {
  double best_score = -1.0;
  double best = 0.0;
  std::array<std::vector<double>, 2> along;
  const std::size_t stride = 1 + (object.points.size() - 1) / kHeadingPoints;
  for (int step = 0; step < kHeadingSteps; ++step) {
    const double heading = step * 0.5 * std::numbers::pi / kHeadingSteps;
    const Eigen::Matrix3d axes = ground.axes(heading);
    std::array<Interval, 2> sides;
    for (int k = 0; k < 2; ++k) {
      auto& values = along[static_cast<std::size_t>(k)];
      values.clear();
      for (std::size_t i = 0; i < object.points.size(); i += stride) {
        values.push_back(axes.col(k).dot(object.points[i]));
      }
      std::vector<double> sorted = values;
      sides[static_cast<std::size_t>(k)] = trimmed_interval(sorted, kTrim);
    }
    double score = 0.0;
    for (std::size_t i = 0; i < along[0].size(); ++i) {
      const auto to_side = [&](std::size_t k) {
        return std::min(std::abs(along[k][i] - sides[k].low),
                        std::abs(along[k][i] - sides[k].high));
      };
      score += 1.0 / std::max(kSidePoint, std::min(to_side(0), to_side(1)));
    }
    if (score > best_score) {
      best_score = score;
      best = heading;
    }
  }
  return best;
}

}  // namespace mms
