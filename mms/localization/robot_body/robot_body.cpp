#include "mms/localization/robot_body/robot_body.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "mms/geometry/se3.hpp"
#include "mms/localization/features/feature_exclusion.hpp"
#include "mms/localization/robot_body/view_comparison.hpp"

namespace mms {
namespace {

using Seen = DepthView::Seen;
using Votes = ViewComparison::Votes;

/// [-]: share of the nodes with a return that a part must have. Source: initial choice; smaller
/// ones do not hold the pose.
constexpr double kMinShare = 0.02;

/// [s]: time before the next reference frame; it doubles where two poses were estimated without a
/// result. Source: computing time.
constexpr Duration kMinInterval = std::chrono::milliseconds(500);

/// [s]: its limit. Source: computing time; half of the frames are registered twice at most.
constexpr Duration kMaxInterval = std::chrono::seconds(2);

/// [s]: age of the reference frame. Source: initial choice; the pose of a sensor at rest drifts.
constexpr Duration kMaxAge = std::chrono::seconds(10);

/// [s]: time for which parts that the pose contradicts must be constant. Source: initial choice;
/// people who walk ahead are so for less.
constexpr Duration kMinAge = std::chrono::seconds(1);

/// [m]: motion after which the search begins anew. Source: initial choice; parts contradict it
/// clearly then.
constexpr double kMaxMotion = 0.3;

/// [rad]: the same of turns. Source: as `kMaxMotion`, at 1 m.
constexpr double kMaxTurn = 0.3;

/// [-]: share of the compared nodes of parts that must contradict the motion. Source: initial
/// choice; those beside each other on a plane do not.
constexpr double kMinContradiction = 0.6;

/// [-]: share of the other compared nodes that must agree with it. Source: initial choice.
constexpr double kMinAgreement = 0.7;

/// [-]: share of the nodes of parts that must be compared. Source: initial choice.
constexpr double kMinCompared = 0.2;

/// [-]: share of the nodes beside constant ones that must have changed before a pose without these
/// is estimated. Source: initial choice; the sensor has moved then.
constexpr double kMinChange = 0.1;

/// [s]: time for which it is. Source: computing time; both poses differ by then.
constexpr Duration kMaxIgnoring = std::chrono::seconds(2);

/// [-]: share of the nodes on which two poses differ that must support the one that ignores the
/// constant nodes. Source: initial choice; people who pass a camera at rest do not cover all of it.
constexpr double kMinSupport = 0.9;

/// [-]: share of the compared nodes on which both poses must differ. Source: at most 0.06 without
/// parts of the robot on `desk_crowd`, 0.2 to 0.4 with them in `crowd`.
constexpr double kMinDecided = 0.2;

/// [-]: the same where the constant nodes contradict the pose that ignores them. Source: 0.13 with
/// parts of the robot in `warehouse_loop`.
constexpr double kMinDecidedContrary = 0.1;

/// [-]: ratio of the photometric residuals at both poses that supports the one that ignores the
/// constant nodes, where these contradict it. Source: 1.7 to 3.7 in `warehouse_loop`.
constexpr double kMinResidualRatio = 1.5;

/// [m]: distance of both poses from which on the odometry begins anew. Source: a part that moved
/// the pose by 1.5 cm on `desk_crowd` left a better odometry than a new one (1.1 and 3.0 cm).
constexpr double kMinHold = 0.03;

/// [rad]: the same of the angle. Source: as `kMinHold`, at 1.5 m.
constexpr double kMinHoldTurn = 0.02;

int count(const Image<std::uint8_t>& nodes) {
  return static_cast<int>(nodes.size() - static_cast<std::size_t>(std::count(
                                             nodes.pixels().begin(), nodes.pixels().end(), 0)));
}

bool contradict(const Votes& constant, int nodes) {
  return constant.compared() >= kMinCompared * 2 * nodes &&
         constant.other >= kMinContradiction * constant.compared();
}

/// Whether a pose is far enough from another one to begin anew there.
bool is_far(const Eigen::Isometry3d& difference) {
  return difference.translation().norm() > kMinHold || se3::angle(difference) > kMinHoldTurn;
}

bool moves(const Eigen::Isometry3d& motion) {
  return motion.translation().norm() > kMaxMotion || se3::angle(motion) > kMaxTurn;
}

/// The features without those at constant nodes.
FeatureCloud beside(const Image<std::uint8_t>& constant, const RobotBody::SeenFrame& frame) {
  FeatureCloud features = frame.features;
  LabeledCloud grid;
  grid.camera = frame.view.camera();
  grid.width = grid.camera.width;
  grid.height = grid.camera.height;
  Image<std::uint8_t> points(grid.width, grid.height);
  for (int v = 0; v < points.height(); ++v) {
    for (int u = 0; u < points.width(); ++u) {
      const int x = u / kNodeStep;
      const int y = v / kNodeStep;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (constant.contains(x + dx, y + dy) && constant(x + dx, y + dy) != 0) points(u, v) = 1;
        }
      }
    }
  }
  exclude(points, grid, features);
  return features;
}

}  // namespace

Image<std::uint8_t> RobotBody::near_nodes(const DepthView& view) const {
  const Image<DepthView::Node>& nodes = view.nodes();
  Image<std::uint8_t> near(nodes.width(), nodes.height());
  for (std::size_t i = 0; i < near.size(); ++i) {
    near[i] = nodes[i].is_valid() && nodes[i].point.z() < config_.max_distance ? 1 : 0;
  }
  return near;
}

std::optional<RobotBody::SeenFrame> RobotBody::see(const LabeledCloud& cloud,
                                                   const FeatureCloud& features) const {
  if (!config_.enabled || !cloud.organised()) return std::nullopt;
  DepthView view(cloud, noise_);
  if (count(near_nodes(view)) <= kMinShare * view.valid_nodes()) return std::nullopt;
  return SeenFrame{std::move(view), features};
}

RobotBody::Found RobotBody::search(const std::optional<SeenFrame>& frame, const Odometry& odometry,
                                   const OdometryEstimate& estimate) {
  if (reference_) {
    if (frame) keep_constant(frame->view);
    if (!frame || is_over(frame->view, estimate)) end(estimate.stamp);
  } else if (frame && estimate.status != Status::kLost) {
    begin(*frame, odometry, estimate);
  }
  return reference_ ? compare(*frame, estimate) : Found{};
}

/// Compares the frame with the reference.
RobotBody::Found RobotBody::compare(const SeenFrame& frame, const OdometryEstimate& estimate) {
  const Eigen::Isometry3d motion =
      (reference_->estimate.T_world_sensor.inverse() * estimate.T_world_sensor).isometry();
  Found found;
  if (ignore_constant(frame, estimate.stamp) && is_supported(frame, motion)) {
    found.is_new = true;
    const Transform<World, Sensor>& ignoring = reference_->ignoring->estimate.T_world_sensor;
    if (is_far((ignoring.inverse() * estimate.T_world_sensor).isometry())) {
      found.correction = Correction{reference_->ignoring->odometry, reference_->ignoring->estimate};
    }
  }
  const bool is_old = estimate.stamp - reference_->estimate.stamp >= kMinAge;
  found.is_new = found.is_new || (is_old && is_contradicted(frame.view, motion));
  if (found.is_new) parts_.add(reference_->frame.view, reference_->constant);
  if (found.is_new || moves(motion)) end(estimate.stamp);
  if (found.is_new) interval_ = Duration::zero();
  return found;
}

void RobotBody::sense(const MotionSamples& samples, const MotionCalibration& calibration) {
  if (!reference_) return;
  constexpr bool kIsCamera = true;
  reference_->odometry.sense(samples, calibration, kIsCamera);
  if (reference_->ignoring) reference_->ignoring->odometry.sense(samples, calibration, kIsCamera);
}

void RobotBody::begin(const SeenFrame& frame, const Odometry& odometry,
                      const OdometryEstimate& estimate) {
  if (estimate.stamp - last_end_ < interval_) return;
  Image<std::uint8_t> near = near_nodes(frame.view);
  const int nodes = count(near);
  reference_.emplace(Reference{frame, odometry, estimate, std::move(near), nodes});
  reference_->odometry.restart();
}

bool RobotBody::is_over(const DepthView& view, const OdometryEstimate& estimate) const {
  const std::optional<Ignoring>& ignoring = reference_->ignoring;
  return estimate.status == Status::kLost || reference_->nodes <= kMinShare * view.valid_nodes() ||
         estimate.stamp - reference_->estimate.stamp > kMaxAge ||
         (ignoring && estimate.stamp - ignoring->since > kMaxIgnoring);
}

void RobotBody::end(Timestamp stamp) {
  const bool was_costly = reference_->ignoring.has_value();
  reference_.reset();
  last_end_ = stamp;
  interval_ = was_costly ? std::clamp(2 * interval_, kMinInterval, kMaxInterval) : kMinInterval;
}

/// Constant nodes are those that have been so in all frames.
void RobotBody::keep_constant(const DepthView& view) {
  reference_->nodes = 0;
  Image<std::uint8_t>& constant = reference_->constant;
  if (!view.nodes().same_size(constant)) return;
  for (int y = 0; y < constant.height(); ++y) {
    for (int x = 0; x < constant.width(); ++x) {
      const bool is_masked = view.nodes()(x, y).is_masked;
      if (is_masked || reference_->frame.view.has_changed(x, y, view)) constant(x, y) = 0;
      reference_->nodes += constant(x, y);
    }
  }
}

/// Whether the image has changed beside the constant nodes since the reference.
bool RobotBody::has_changed(const DepthView& view) const {
  const DepthView& before = reference_->frame.view;
  const Image<std::uint8_t>& constant = reference_->constant;
  int compared = 0, changed = 0;
  for (int y = 0; y < constant.height(); ++y) {
    for (int x = 0; x < constant.width(); ++x) {
      const bool are_valid = before.nodes()(x, y).is_valid() && view.nodes()(x, y).is_valid();
      if (constant(x, y) != 0 || !are_valid) continue;
      ++compared;
      changed += before.has_changed(x, y, view) ? 1 : 0;
    }
  }
  return changed > kMinChange * compared;
}

/// Estimates the pose without constant nodes, once the image has changed.
/// @returns whether there is one
bool RobotBody::ignore_constant(const SeenFrame& frame, Timestamp stamp) {
  std::optional<Ignoring>& ignoring = reference_->ignoring;
  if (!ignoring) {
    if (!has_changed(frame.view)) return false;
    Odometry& odometry = reference_->odometry;
    const OdometryEstimate begin =
        odometry.estimate(beside(reference_->constant, reference_->frame));
    if (begin.status == Status::kLost) return false;
    ignoring.emplace(Ignoring{odometry, odometry, begin.T_world_sensor, stamp});
  }
  ignoring->estimate = ignoring->odometry.estimate(beside(reference_->constant, frame));
  return ignoring->estimate.status != Status::kLost;
}

/// Whether the other nodes support the pose without constant ones, and not the given one.
bool RobotBody::is_supported(const SeenFrame& frame,
                             const Eigen::Isometry3d& T_reference_now) const {
  const Ignoring& ignoring = *reference_->ignoring;
  const Eigen::Isometry3d motion =
      (ignoring.T_world_reference.inverse() * ignoring.estimate.T_world_sensor).isometry();
  const DepthView& before = reference_->frame.view;
  const ViewComparison holding(before, frame.view, reference_->constant, T_reference_now);
  const ViewComparison without(before, frame.view, reference_->constant, motion);
  Votes constant;
  int compared = 0, decided = 0, supporting = 0;
  without.for_each_node([&](bool is_constant, const Eigen::Vector3f& point, bool is_now) {
    if (is_constant) return constant.add(without.seen_constant(point, is_now));
    const Seen ours = without.seen(point, is_now);
    const Seen theirs = holding.seen(point, is_now);
    if (ours == Seen::kNothing || theirs == Seen::kNothing) return;
    ++compared;
    if (ours == theirs) return;
    ++decided;
    supporting += ours == Seen::kSame;
  });
  const bool are_contrary = contradict(constant, reference_->nodes);
  const double least = (are_contrary ? kMinDecidedContrary : kMinDecided) * compared;
  if (decided >= least && supporting >= kMinSupport * decided) return true;
  if (!are_contrary) return false;
  const FeatureCloud features = beside(reference_->constant, frame);
  const auto residual = [&](const Eigen::Isometry3d& T_begin_now) {
    const Eigen::Isometry3d pose = ignoring.T_world_reference.isometry() * T_begin_now;
    return ignoring.at_reference.fit(features, pose).intensity_sigma;
  };
  const double own = residual(motion);
  return own > 0.0 && residual(T_reference_now) > kMinResidualRatio * own;
}

/// Whether the constant nodes contradict the pose, and the others do not.
bool RobotBody::is_contradicted(const DepthView& view,
                                const Eigen::Isometry3d& T_reference_now) const {
  const DepthView& before = reference_->frame.view;
  const ViewComparison comparison(before, view, reference_->constant, T_reference_now);
  Votes constant, others;
  comparison.for_each_node([&](bool is_constant, const Eigen::Vector3f& point, bool is_now) {
    if (is_constant) return constant.add(comparison.seen_constant(point, is_now));
    others.add(comparison.seen(point, is_now));
  });
  return contradict(constant, reference_->nodes) &&
         others.same >= kMinAgreement * others.compared();
}

}  // namespace mms
