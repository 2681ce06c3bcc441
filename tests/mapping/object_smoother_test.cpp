#include "mms/mapping/tracking/object_smoother.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mms {
namespace {

constexpr double kStep = 0.05;  // between frames [s]
const Eigen::Vector3d kUp(0, 0, 1);

Timestamp stamp_of(int frame) {
  return Timestamp::from_seconds(1.0 + kStep * frame);
}

/// Velocity of an object that moves for the first half of its frames, then stops [m/s].
double true_speed(int frame, int frames) {
  return frame < frames / 2 ? 1.0 : 0.0;
}

/// Such an object as the dynamic map tracks it, frame by frame.
std::vector<TrackedObject> stopping_object(int id, int frames, const DynamicMapConfig& config) {
  std::vector<TrackedObject> tracked;
  MotionFilter motion(Eigen::Vector3d::Zero(), kUp, 0.1, 0.7);
  double distance = 0.0;
  bool moving = false;
  for (int i = 0; i < frames; ++i) {
    if (i > 0) {
      motion.predict(kStep, config.track.acceleration_noise);
      distance += kStep * true_speed(i - 1, frames);
    }
    motion.update({distance, 0.0, 0.0}, {0.03});
    moving = config.track.is_moving(motion.velocity().norm(), moving);
    ObjectBox box;
    box.id = id;
    box.T_world_box.translation() = motion.position();
    box.velocity = motion.velocity();
    box.moving = moving;
    tracked.push_back({box, TrackState::kActive, motion, stamp_of(0), stamp_of(i)});
  }
  return tracked;
}

ObjectHistory smoothed(const std::vector<TrackedObject>& tracked, const DynamicMapConfig& config) {
  ObjectSmoother smoother(config);
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    smoother.add(stamp_of(static_cast<int>(i)), {tracked[i]});
  }
  return smoother.history();
}

double velocity_rmse(const std::vector<ObjectBox>& boxes) {
  double sum = 0.0;
  const int frames = static_cast<int>(boxes.size());
  for (int i = 0; i < frames; ++i) {
    sum += std::pow(boxes[static_cast<std::size_t>(i)].velocity.x() - true_speed(i, frames), 2);
  }
  return std::sqrt(sum / frames);
}

std::vector<ObjectBox> boxes_of(const ObjectHistory& history) {
  std::vector<ObjectBox> boxes;
  for (const ObjectFrame& frame : history) boxes.push_back(frame.objects.at(0));
  return boxes;
}

std::vector<ObjectBox> boxes_of(const std::vector<TrackedObject>& tracked) {
  std::vector<ObjectBox> boxes;
  for (const TrackedObject& object : tracked) boxes.push_back(object.box);
  return boxes;
}

TEST(ObjectSmoother, ReducesVelocityErrorAtStop) {
  const DynamicMapConfig config;
  const auto tracked = stopping_object(7, 100, config);
  const double online = velocity_rmse(boxes_of(tracked));
  const double smooth = velocity_rmse(boxes_of(smoothed(tracked, config)));
  EXPECT_LT(smooth, 0.6 * online) << "online " << online << ", smoothed " << smooth << " m/s";
}

TEST(ObjectSmoother, ReturnsEveryFrameOnceInOrder) {
  const DynamicMapConfig config;
  const auto tracked = stopping_object(7, 100, config);
  const ObjectHistory history = smoothed(tracked, config);
  ASSERT_EQ(history.size(), tracked.size());
  for (std::size_t i = 0; i < history.size(); ++i) {
    EXPECT_EQ(history[i].stamp, stamp_of(static_cast<int>(i)));
    ASSERT_EQ(history[i].objects.size(), 1U);
    EXPECT_EQ(history[i].objects[0].id, 7);
  }
}

/// Whether the frames are taken all at the end or as soon as later ones do not change them.
TEST(ObjectSmoother, TakenFramesAreTheSame) {
  const DynamicMapConfig config;
  const auto tracked = stopping_object(7, 100, config);
  const ObjectHistory whole = smoothed(tracked, config);
  ObjectSmoother smoother(config);
  ObjectHistory parts;
  const auto add = [&](ObjectHistory frames) {
    parts.insert(parts.end(), frames.begin(), frames.end());
    return frames.size();
  };
  std::size_t taken = 0;
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    smoother.add(stamp_of(static_cast<int>(i)), {tracked[i]});
    taken += add(smoother.take_settled());
  }
  EXPECT_GT(taken, tracked.size() / 4);
  add(smoother.history());
  ASSERT_EQ(parts.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(parts[i].stamp, whole[i].stamp);
    EXPECT_EQ(parts[i].objects[0].center(), whole[i].objects[0].center());
  }
}

TEST(ObjectSmoother, MotionStateAgreesWithVelocity) {
  const DynamicMapConfig config;
  for (const ObjectBox& box : boxes_of(smoothed(stopping_object(1, 100, config), config))) {
    const double speed = box.velocity.norm();
    const bool is_fast = speed > config.track.moving_speed;
    const bool is_slow = speed < config.track.stopped_speed;
    EXPECT_FALSE(is_fast && !box.moving) << speed;
    EXPECT_FALSE(is_slow && box.moving) << speed;
  }
}

TEST(ObjectSmoother, ZeroLagEqualsOnlineEstimate) {
  DynamicMapConfig config;
  config.history_lag = 0.0;
  const auto tracked = stopping_object(1, 40, config);
  const ObjectHistory history = smoothed(tracked, config);
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    EXPECT_EQ(history[i].objects[0].velocity, tracked[i].box.velocity);
    EXPECT_EQ(history[i].objects[0].center(), tracked[i].box.center());
  }
}

TEST(ObjectSmoother, LagApproximatesWholeRun) {
  DynamicMapConfig config;
  const auto tracked = stopping_object(1, 200, config);
  const auto lagged = boxes_of(smoothed(tracked, config));
  config.history_lag = 60.0;
  const auto whole = boxes_of(smoothed(tracked, config));
  for (std::size_t i = 0; i < tracked.size(); ++i) {
    EXPECT_NEAR((lagged[i].velocity - whole[i].velocity).norm(), 0.0, 0.1) << "frame " << i;
  }
}

TEST(ObjectSmoother, ObjectsAreIndependent) {
  const DynamicMapConfig config;
  const auto first = stopping_object(1, 60, config);
  auto second = stopping_object(2, 60, config);
  std::reverse(second.begin(), second.end());  // any other motion
  ObjectSmoother smoother(config);
  for (std::size_t i = 0; i < first.size(); ++i) {
    smoother.add(stamp_of(static_cast<int>(i)), {first[i], second[i]});
  }
  const ObjectHistory together = smoother.history();
  const ObjectHistory alone = smoothed(first, config);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(together[i].objects[0].velocity, alone[i].objects[0].velocity);
  }
}

TEST(ObjectSmoother, KeepsFramesWithoutObjects) {
  const DynamicMapConfig config;
  const auto tracked = stopping_object(3, 100, config);
  ObjectSmoother smoother(config);
  for (int i = 0; i < 100; ++i) {
    const bool gone = i >= 40 && i < 50;
    smoother.add(stamp_of(i), gone ? std::vector<TrackedObject>{}
                                   : std::vector{tracked[static_cast<std::size_t>(i)]});
  }
  const ObjectHistory history = smoother.history();
  ASSERT_EQ(history.size(), 100U);
  EXPECT_EQ(history[45].objects.size(), 0U);
  EXPECT_EQ(history[55].objects.size(), 1U);
}

TEST(ObjectSmoother, DoesNotSmoothFramesOutOfOrder) {
  const DynamicMapConfig config;
  const auto tracked = stopping_object(3, 10, config);
  ObjectSmoother smoother(config);
  smoother.add(stamp_of(5), {tracked[5]});
  smoother.add(stamp_of(5), {tracked[5]});
  smoother.add(stamp_of(2), {tracked[9]});
  const ObjectHistory history = smoother.history();
  ASSERT_EQ(history.size(), 3U);
  EXPECT_EQ(history[0].objects[0].center(), tracked[5].box.center());
  EXPECT_EQ(history[1].objects[0].velocity, tracked[5].box.velocity);
  EXPECT_EQ(history[2].objects[0].velocity, tracked[9].box.velocity);
}

}  // namespace
}  // namespace mms
