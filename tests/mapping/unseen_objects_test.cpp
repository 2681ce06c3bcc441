#include "mms/mapping/tracking/unseen_objects.hpp"

#include <gtest/gtest.h>

#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

using test::dynamic_points;
using test::organised_cloud;
using test::pose;

/// A tracked person 0.5 m wide and deep and 1.7 m high. The camera is 1 m above the floor.
TrackedObject person_at(const Eigen::Vector3d& center, TrackState state) {
  TrackedObject person{{}, state, MotionFilter(center, {0.0, -1.0, 0.0}, 0.1, 0.1), {}, {}};
  person.box.size = {0.5, 0.5, 1.7};
  person.box.T_world_box.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // z up, against the camera's y
  person.box.T_world_box.translation() = center;
  return person;
}

const Eigen::Vector3d kCenter(0.0, 0.15, 2.0);

/// A wall at 3 m, a floor 1 m below the camera, and a person in front of the wall.
LabeledCloud room() {
  return organised_cloud([](int x, int y, const Eigen::Vector3f& ray) {
    const bool is_person = x >= 70 && x < 90 && y >= 20 && ray.y() * 2.0F < 1.0F;
    const float depth = is_person ? 2.0F : 3.0F;
    return ray.y() * depth > 1.0F ? 1.0F / ray.y() : depth;
  });
}

TEST(UnseenObjects, MaskPointsAtPredictedBox) {
  LabeledCloud cloud = room();
  const std::size_t count =
      mask_unseen_objects({person_at(kCenter, TrackState::kCoasting)}, pose({0, 0, 0}), cloud);
  EXPECT_EQ(count, dynamic_points(cloud));
  EXPECT_GT(count, 1000U);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& point = cloud.points[i];
    const bool is_floor = point.y() > 0.99F;
    const bool is_person = !is_floor && point.z() < 2.5F && std::abs(point.x()) < 0.35F;
    EXPECT_EQ(cloud.labels[i] == PointLabel::kDynamic, is_person) << point.transpose();
  }
}

TEST(UnseenObjects, ArePredictedInWorldFrame) {
  LabeledCloud cloud = room();
  const auto other_pose = pose({3.0, 0.0, 0.0});
  EXPECT_EQ(mask_unseen_objects({person_at(kCenter, TrackState::kCoasting)}, other_pose, cloud),
            0U);
  const TrackedObject moved =
      person_at(kCenter + Eigen::Vector3d(3.0, 0.0, 0.0), TrackState::kCoasting);
  EXPECT_GT(mask_unseen_objects({moved}, other_pose, cloud), 1000U);
}

TEST(UnseenObjects, DoNotIncludeActiveTracks) {
  LabeledCloud cloud = room();
  EXPECT_EQ(mask_unseen_objects({person_at(kCenter, TrackState::kActive)}, pose({0, 0, 0}), cloud),
            0U);
  EXPECT_EQ(dynamic_points(cloud), 0U);
}

}  // namespace
}  // namespace mms
