#include "mms/mapping/tracking/box_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

/// [-]: share of the points at either end that may be stray. Source: eight of the 400 points of a
/// measurement, as flying pixels at a boundary leave them.
constexpr double kTrimmedShare = 0.02;

/// [-]: the same along the upright axis. Source: a head has about 6 % of a body's visible points,
/// of which `kTrimmedShare` would be a third.
constexpr double kUprightTrimmedShare = 0.005;

/// [-]: sine of the angle between view and face from which the face is visible. Source: 15 degrees;
/// depth cameras give few returns at flatter ones.
constexpr double kMinFaceSine = 0.25;

/// [-]: cosine of the angle between an axis and the image's rows up to which an end is at the left
/// or right. Source: 73 degrees; beyond it left and right ends overlap in the image.
constexpr double kMinSideCosine = 0.3;

/// [-]: share of the known size below which a part of an object gives no returns. Source: by
/// experiment on the simulated scenes; legs and arms in motion change a size by less.
constexpr double kMinCompleteShare = 0.8;

/// [m]: distance to a rectangle's side below which all points are equally close. Source: a standard
/// deviation of the Kinect's depth noise at 3.5 m.
constexpr double kMinSideDistance = 0.02;

/// [m]: error of the floor's height under an object. Source: two degrees of tilt at 6 m.
constexpr double kMaxFloorError = 0.2;

/// [m]: height over the floor up to which an object that stands on it may be hidden. Source: tables
/// and loaded pallets are up to 1.2 m high.
constexpr double kMaxHiddenHeight = 1.2;

/// [-]: headings tested over a quarter of a turn. Source: steps of two degrees, which move the ends
/// of a box 1.2 m long by 2 cm.
constexpr int kHeadingSteps = 45;

/// [-]: points that a heading is estimated from. Source: bounds the time; each of two visible sides
/// still has dozens.
constexpr std::size_t kMaxHeadingPoints = 100;

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

Interval trimmed_interval(std::vector<double>& values, double trim) {
  const auto trimmed = static_cast<std::ptrdiff_t>(trim * static_cast<double>(values.size()));
  const auto low = values.begin() + trimmed;
  const auto high = values.end() - 1 - trimmed;
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

/// The ends that are truncated neither by the image's border nor by an occluder.
Ends visible_ends(const ObjectMeasurement& object, const Eigen::Vector3d& axis, bool upright) {
  if (upright) return {!object.truncation.bottom, !object.truncation.top};
  const double rightness = axis.dot(object.right);
  if (std::abs(rightness) < kMinSideCosine) return {};
  const bool left = !object.truncation.left;
  const bool right = !object.truncation.right;
  return rightness > 0.0 ? Ends{left, right} : Ends{right, left};
}

/// The ends that the object itself does not hide: both where a side along the axis is visible, else
/// the nearer one.
Ends unhidden_ends(double sensor_along, const Interval& along, bool side_in_view) {
  if (side_in_view) return {};
  const double center = 0.5 * (along.low + along.high);
  return sensor_along < center ? Ends{true, false} : Ends{false, true};
}

/// The end that lies nearer to its expected position.
Ends nearer_end(const Interval& seen, double expected, double size) {
  const double low_off = std::abs(seen.low - (expected - 0.5 * size));
  const double high_off = std::abs(seen.high - (expected + 0.5 * size));
  return low_off < high_off ? Ends{true, false} : Ends{false, true};
}

double center_of(const Interval& seen, const Ends& ends, double size) {
  if (ends.low == ends.high) return 0.5 * (seen.low + seen.high);
  return ends.low ? seen.low + 0.5 * size : seen.high - 0.5 * size;
}

/// Whether an object of which an interval is visible stands on the floor.
bool stands_on(const std::optional<double>& floor, const Interval& seen) {
  return floor && seen.low > *floor - kMaxFloorError && seen.low < *floor + kMaxHiddenHeight &&
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
    Interval seen = interval_along(object, axis, upright ? kUprightTrimmedShare : kTrimmedShare);
    const bool stands = upright && stands_on(ground.floor(), seen);
    if (stands) seen.low = *ground.floor();
    // A horizontal axis runs along the face whose normal is the other one.
    const bool side_in_view = upright || std::abs(view.dot(axes.col(1 - k))) > kMinFaceSine;
    Ends visible = visible_ends(object, axis, upright);
    visible.low = visible.low || stands;
    const Ends unhidden = unhidden_ends(axis.dot(object.sensor), seen, side_in_view);
    Ends ends = {visible.low && unhidden.low, visible.high && unhidden.high};
    // The known size is in view: nothing is hidden.
    if (seen.high - seen.low >= size[k]) ends = {};
    const bool both = ends.low && ends.high;
    if (both && expected && !stands && seen.high - seen.low < kMinCompleteShare * size[k]) {
      ends = nearer_end(seen, axis.dot(*expected), size[k]);
    }
    const auto i = static_cast<std::size_t>(k);
    fit.whole[i] = visible.low && visible.high && side_in_view;
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
  const std::size_t stride = 1 + (object.points.size() - 1) / kMaxHeadingPoints;
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
      sides[static_cast<std::size_t>(k)] = trimmed_interval(sorted, kTrimmedShare);
    }
    double score = 0.0;
    for (std::size_t i = 0; i < along[0].size(); ++i) {
      const auto to_side = [&](std::size_t k) {
        return std::min(std::abs(along[k][i] - sides[k].low),
                        std::abs(along[k][i] - sides[k].high));
      };
      score += 1.0 / std::max(kMinSideDistance, std::min(to_side(0), to_side(1)));
    }
    if (score > best_score) {
      best_score = score;
      best = heading;
    }
  }
  return best;
}

}  // namespace mms
