#include "mms/mapping/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

/// [-]: views over which a size is averaged. Source: two seconds of the simulated scenes at 15 Hz,
/// two cycles of a person's gait.
constexpr int kMaxSizeViews = 30;

/// [-]: share of the excess by which a larger view of a truncated object makes the size grow.
/// Source: by experiment on the simulated scenes; three views in agreement close two thirds of it.
constexpr double kTruncatedGrowthGain = 0.3;

/// [-]: views in which a height is averaged before it shrinks slowly. Source: a mean of five has
/// less than half the error of one.
constexpr int kInitialHeightViews = 5;

/// [-]: share of the difference by which a height shrinks a view. Source: the gain of a complete
/// average of a person, 1 / (`kMaxSizeViews` + 20 views of the prior).
constexpr double kHeightShrinkGain = 0.02;

/// [-]: observations over which a score is averaged. Source: that of sizes.
constexpr int kMaxScoreObservations = 30;

/// [-]: share of a new view in a track's appearance. Source: by experiment on the simulated scenes;
/// ten views, in which a body turns little.
constexpr float kAppearanceGain = 0.1F;

/// [-]: share of a new view in a track's heading. Source: by experiment on the simulated scenes;
/// averages about five views.
constexpr double kHeadingGain = 0.2;

/// [m/s]: speed from which the velocity gives the heading. Source: 1.5 standard deviations of the
/// filter's velocity, 0.19 m/s in the steady state at 15 Hz.
constexpr double kMinHeadingSpeed = 0.3;

/// [-]: distance of a body's center behind the mean of its visible points, relative to half its
/// mean width. Source: by experiment on simulated people; a cylinder has pi/4, but limbs are
/// thinner than the box around them.
constexpr double kBodyDepthRatio = 0.32;

/// Difference of headings in [-period/2, period/2).
double turn(double from, double to, double period) {
  const double difference = to - from;
  return difference - period * std::floor(difference / period + 0.5);
}

bool is_named(const ObjectMeasurement& object) {
  return object.score > 0.0F;
}

bool is_round(ObjectClass object_class) {
  return object_class == ObjectClass::kPerson;
}

MotionFilter initial_motion(const Eigen::Vector3d& position, const GroundFrame& ground,
                            const TrackConfig& config) {
  return MotionFilter(position, ground.up(), config.initial_position_sigma,
                      config.initial_velocity_sigma);
}

}  // namespace

Track::Track(int id, const ObjectMeasurement& first, const GroundFrame& ground,
             const TrackConfig& config)
    : config_(config),
      ground_(ground),
      id_(id),
      first_seen_(first.stamp),
      last_seen_(first.stamp),
      last_evidence_(first.stamp),
      predicted_(first.stamp),
      last_position_(first.centroid),
      motion_(initial_motion(first.centroid, ground, config)),
      heading_(ground.heading_of(first.sensor - first.centroid)),
      size_(config.classes[static_cast<std::size_t>(first.object_class)].size()) {
  if (is_named(first)) update_class(first);
  learn_heading(first);
  motion_ = initial_motion(fit(first, std::nullopt).center, ground, config);
  add_view(first, false);
}

void Track::set_ground(const GroundFrame& ground) {
  ground_ = ground;
  motion_.set_up(ground.up());
}

void Track::predict(Timestamp stamp) {
  if (stamp <= predicted_) return;
  motion_.predict(to_seconds(stamp - predicted_), config_.acceleration_noise);
  predicted_ = stamp;
}

BoxFit Track::fit(const ObjectMeasurement& object,
                  const std::optional<Eigen::Vector3d>& expected) const {
  BoxFit fit = fit_box(object, ground_, heading_, size_, expected);
  if (!is_round(object_class()) || object.truncation.left || object.truncation.right) return fit;
  const Eigen::Vector3d view = ground_.horizontal(object.centroid - object.sensor).normalized();
  const double radius = 0.25 * (size_.x() + size_.y());
  const double height = ground_.up().dot(fit.center);
  fit.center =
      ground_.horizontal(object.centroid + kBodyDepthRatio * radius * view) + height * ground_.up();
  return fit;
}

void Track::update_class(const ObjectMeasurement& object) {
  const ObjectClass before = object_class();
  ++votes_[static_cast<std::size_t>(object.object_class)];
  ++observations_;
  score_ +=
      (static_cast<double>(object.score) - score_) / std::min(observations_, kMaxScoreObservations);
  if (object_class() == before) return;
  size_ = config_.classes[static_cast<std::size_t>(object_class())].size();
  whole_views_ = {};
}

void Track::update(const ObjectMeasurement& object, bool shared) {
  if (is_named(object)) update_class(object);
  add_view(object, shared);
}

void Track::add_view(const ObjectMeasurement& object, bool shared) {
  const bool moves = object.object_class == ObjectClass::kUnknown;
  if (moves) ++motion_detections_;
  if (is_named(object) || moves) last_evidence_ = object.stamp;
  last_seen_ = object.stamp;
  const BoxFit seen = fit(object);
  motion_.update(seen.center, error_of(object, shared || !seen.anchored));
  motion_.limit_speed(config_.max_speed);
  moving_ = config_.is_moving(motion_.velocity().norm(), moving_);
  if (!shared) learn_shape(object);
  last_position_ = motion_.position();
}

PositionError Track::error_of(const ObjectMeasurement& object, bool is_unanchored) const {
  PositionError error;
  const double range = (object.centroid - object.sensor).norm();
  error.noise = std::hypot(config_.position_sigma, config_.range_sigma * range);
  if (object.truncation.left || object.truncation.right) error.offset = config_.truncated_sigma;
  if (is_unanchored) error.offset = config_.unanchored_sigma;
  return error;
}

void Track::learn_shape(const ObjectMeasurement& object) {
  const Eigen::Vector3d expected = motion_.position();
  const Eigen::Vector3d before = fit(object, expected).center;
  if (!object.truncation.any()) learn_heading(object);
  learn_size(fit(object, expected));
  appearance_.learn(object.appearance, kAppearanceGain);
  // A new size or heading shifts the center, which is no motion.
  motion_.shift(fit(object, expected).center - before);
}

void Track::continue_as(const Track& lost) {
  id_ = lost.id_;
  first_seen_ = lost.first_seen_;
  for (std::size_t i = 0; i < votes_.size(); ++i) votes_[i] += lost.votes_[i];
  size_ = lost.size_;
  whole_views_ = lost.whole_views_;
  confirmed_ = true;
}

void Track::learn_size(const BoxFit& fit) {
  const ClassPrior& prior = config_.classes[static_cast<std::size_t>(object_class())];
  for (std::size_t k = 0; k < 3; ++k) {
    double& size = size_[static_cast<Eigen::Index>(k)];
    const double seen = fit.extent[static_cast<Eigen::Index>(k)];
    if (fit.whole[k]) {
      whole_views_[k] = std::min(whole_views_[k] + 1, kMaxSizeViews);
      // Hair and shoes often give no returns: a measured height is rather too small than too large.
      const bool is_shrinking = k == 2 && seen < size && whole_views_[k] > kInitialHeightViews;
      const double gain = is_shrinking ? kHeightShrinkGain : 1.0 / (prior.views + whole_views_[k]);
      size += gain * (seen - size);
    } else if (seen > size) {
      size += kTruncatedGrowthGain * (seen - size);  // a truncated size is a lower bound
    }
  }
  if (is_round(object_class())) return;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const auto i = static_cast<std::size_t>(k);
    // An object seen from one side only is assumed to be as deep as wide.
    if (whole_views_[i] == 0 && whole_views_[1 - i] > 0) {
      size_[k] = std::max(size_[1 - k], fit.extent[k]);
    }
  }
}

void Track::learn_heading(const ObjectMeasurement& object) {
  const Eigen::Vector3d velocity = ground_.horizontal(motion_.velocity());
  const bool has_course = observations_ > 1 && velocity.norm() > kMinHeadingSpeed;
  const double course = ground_.heading_of(velocity);
  if (is_round(object_class())) {
    if (has_course) heading_ += kHeadingGain * turn(heading_, course, 2.0 * std::numbers::pi);
    return;
  }
  // The sides give the heading up to quarters of a turn, the course or the past the quarter.
  const double near = has_course ? course : heading_;
  const double sides = rectangle_heading(object, ground_);
  const double seen = near + turn(near, sides, 0.5 * std::numbers::pi);
  const double gain = has_heading_ ? kHeadingGain : 1.0;
  heading_ += gain * turn(heading_, seen, 2.0 * std::numbers::pi);
  has_heading_ = true;
}

ObjectClass Track::object_class() const {
  if (std::all_of(votes_.begin(), votes_.end(), [](int votes) { return votes == 0; })) {
    return ObjectClass::kUnknown;
  }
  return static_cast<ObjectClass>(std::max_element(votes_.begin(), votes_.end()) - votes_.begin());
}

ObjectBox Track::box() const {
  ObjectBox box;
  box.id = id_;
  box.object_class = object_class();
  box.T_world_box.linear() = ground_.axes(heading_);
  box.T_world_box.translation() = motion_.position();
  box.size = size_;
  box.velocity = motion_.velocity();
  box.moving = moving_;
  box.score = score_;
  return box;
}

bool Track::contains(const Eigen::Vector3d& point, double margin) const {
  const Eigen::Vector3d local = ground_.axes(heading_).transpose() * (point - motion_.position());
  return (local.array().abs() <= 0.5 * size_.array() + margin).all();
}

}  // namespace mms
