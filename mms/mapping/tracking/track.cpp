#include "mms/mapping/tracking/track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mms {
namespace {

constexpr double kFirstPositionSigma = 0.2;  // [m]
constexpr double kFirstVelocitySigma = 0.7;  // [m/s]
constexpr double kRangeSigma = 0.005;        // of a center per metre of range
constexpr int kSizeMemory = 30;              // views over which a size is averaged
constexpr double kGrowth = 0.3;              // share of an excess by which a size grows at once
constexpr int kFirstViews = 5;               // that tell a size whatever it was taken for
constexpr double kShrinking = 0.02;          // share of a lack by which a height shrinks
constexpr int kScoreMemory = 30;             // observations over which a score is averaged
constexpr float kColorGain = 0.1F;
constexpr double kHeadingGain = 0.2;
constexpr double kHeadingSpeed = 0.3;  // from which a way tells the heading [m/s]

/// The center of a body lies behind that of its visible side by so much of half its mean width: by
/// less than the pi/4 of a cylinder, since limbs are thinner than the box about them.
constexpr double kRoundDepth = 0.32;

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
      motion_(first.centroid, ground.up(), kFirstPositionSigma, kFirstVelocitySigma),
      heading_(ground.heading_of(first.sensor - first.centroid)),
      size_(config.classes[static_cast<std::size_t>(first.object_class)].size()) {
  if (is_named(first)) ++votes_[static_cast<std::size_t>(first.object_class)];
  learn_heading(first);
  motion_ = MotionFilter(fit(first, std::nullopt).center, ground.up(), kFirstPositionSigma,
                         kFirstVelocitySigma);
  votes_ = {};
  update(first, false);
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
      ground_.horizontal(object.centroid + kRoundDepth * radius * view) + height * ground_.up();
  return fit;
}

void Track::update_class(const ObjectMeasurement& object) {
  const ObjectClass before = object_class();
  ++votes_[static_cast<std::size_t>(object.object_class)];
  ++observations_;
  score_ += (static_cast<double>(object.score) - score_) / std::min(observations_, kScoreMemory);
  if (object_class() == before) return;
  size_ = config_.classes[static_cast<std::size_t>(object_class())].size();
  whole_views_ = {};
}

void Track::update(const ObjectMeasurement& object, bool shared) {
  if (is_named(object)) update_class(object);
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
  error.noise = std::hypot(config_.position_sigma, kRangeSigma * range);
  if (object.truncation.left || object.truncation.right) error.offset = config_.truncated_sigma;
  if (is_unanchored) error.offset = config_.unanchored_sigma;
  return error;
}

void Track::learn_shape(const ObjectMeasurement& object) {
  const Eigen::Vector3d expected = motion_.position();
  const Eigen::Vector3d before = fit(object, expected).center;
  if (!object.truncation.any()) learn_heading(object);
  learn_size(fit(object, expected));
  appearance_.learn(object.appearance, kColorGain);
  // Another size or heading puts the center elsewhere, which is no motion.
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
      whole_views_[k] = std::min(whole_views_[k] + 1, kSizeMemory);
      // Hair and shoes are often without returns: a height is sooner too small than too large.
      const bool lacks_some = k == 2 && seen < size && whole_views_[k] > kFirstViews;
      const double gain = lacks_some ? kShrinking : 1.0 / (prior.views + whole_views_[k]);
      size += gain * (seen - size);
    } else if (seen > size) {
      size += kGrowth * (seen - size);  // what is truncation off can only be larger
    }
  }
  if (is_round(object_class())) return;
  for (Eigen::Index k = 0; k < 2; ++k) {
    const auto i = static_cast<std::size_t>(k);
    // What was only seen from one side is taken to be as deep as wide.
    if (whole_views_[i] == 0 && whole_views_[1 - i] > 0) {
      size_[k] = std::max(size_[1 - k], fit.extent[k]);
    }
  }
}

void Track::learn_heading(const ObjectMeasurement& object) {
  const Eigen::Vector3d way = ground_.horizontal(motion_.velocity());
  const bool is_under_way = observations_ > 1 && way.norm() > kHeadingSpeed;
  const double along_way = ground_.heading_of(way);
  if (is_round(object_class())) {
    if (is_under_way) heading_ += kHeadingGain * turn(heading_, along_way, 2.0 * std::numbers::pi);
    return;
  }
  // Sides tell the heading but for quarters of a turn, which its way or the past tells.
  const double near = is_under_way ? along_way : heading_;
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
