#include "mms/mapping/motion_segmentation/mask_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mapping/synthetic_cloud.hpp"

namespace mms {
namespace {

using test::organised_cloud;
using test::pose;

constexpr int kLeft = 60;  // of the box [px]
constexpr int kTop = 30;
constexpr int kWidth = 40;
constexpr int kHeight = 60;

Timestamp at(double seconds) {
  return Timestamp(static_cast<std::int64_t>(1e9 * seconds));
}

bool in_box(int x, int y) {
  return x >= kLeft && x < kLeft + kWidth && y >= kTop && y < kTop + kHeight;
}

/// A wall at 3 m with a box in front of it, at `depth` [m].
LabeledCloud wall_with_box(double seconds, float depth) {
  LabeledCloud cloud = organised_cloud(
      [=](int x, int y, const Eigen::Vector3f&) { return in_box(x, y) ? depth : 3.0F; });
  cloud.stamp = at(seconds);
  return cloud;
}

/// Labels the box as one masked object.
LabeledCloud masked(LabeledCloud cloud) {
  cloud.cluster.assign(cloud.points.size(), -1);
  cloud.clusters.resize(1);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      if (!in_box(x, y)) continue;
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      cloud.labels[i] = PointLabel::kDynamic;
      cloud.cluster[i] = 0;
    }
  }
  return cloud;
}

std::size_t count(const Image<std::uint8_t>& points) {
  return points.size() -
         static_cast<std::size_t>(std::count(points.pixels().begin(), points.pixels().end(), 0));
}

MaskCheck check_with(const LabeledCloud& view, const MaskCheckConfig& config = {}) {
  MaskCheck check(config, {});
  check.remember(view, pose({0, 0, 0}));
  return check;
}

MaskEvidence compare(const LabeledCloud& view, const LabeledCloud& cloud,
                     const Eigen::Vector3d& position = {0, 0, 0}) {
  return check_with(view).compare(cloud, pose(position));
}

TEST(MaskCheck, OverrulesAMaskOnASurfaceSeenBefore) {
  const LabeledCloud cloud = masked(wall_with_box(0.5, 2.0F));
  const MaskEvidence evidence = compare(wall_with_box(0.0, 2.0F), cloud);
  EXPECT_EQ(count(evidence.overruled), static_cast<std::size_t>(kWidth * kHeight));
  EXPECT_NEAR(evidence.overruled_share, 40.0 * 60.0 / (160.0 * 120.0), 1e-9);
  EXPECT_EQ(evidence.masked_agreement, 1.0);
}

TEST(MaskCheck, BelievesAMaskInFreeSpace) {
  const LabeledCloud cloud = masked(wall_with_box(0.5, 2.0F));
  const MaskEvidence evidence = compare(wall_with_box(0.0, 3.0F), cloud);
  EXPECT_TRUE(evidence.overruled.empty());
  EXPECT_EQ(evidence.overruled_share, 0.0);
  EXPECT_LT(evidence.masked_agreement, 0.01);
}

TEST(MaskCheck, BelievesAMaskThatWasThereBefore) {
  const LabeledCloud person = masked(wall_with_box(0.0, 2.0F));
  EXPECT_TRUE(compare(person, masked(wall_with_box(0.5, 2.0F))).overruled.empty());
}

TEST(MaskCheck, BelievesAMaskBehindASurfaceSeenBefore) {
  const LabeledCloud cloud = masked(wall_with_box(0.5, 2.5F));
  EXPECT_TRUE(compare(wall_with_box(0.0, 2.0F), cloud).overruled.empty());
}

TEST(MaskCheck, ContradictsMasksInFreeSpaceOnly) {
  const LabeledCloud cloud = masked(wall_with_box(0.5, 2.0F));
  const auto uncontradicted = [&](const LabeledCloud& view) {
    return count(check_with(view).uncontradicted(cloud, pose({0, 0, 0})));
  };
  const auto all = static_cast<std::size_t>(kWidth * kHeight);
  EXPECT_EQ(uncontradicted(masked(wall_with_box(0.0, 2.0F))), all) << "masked there before";
  EXPECT_EQ(uncontradicted(wall_with_box(0.0, 2.0F)), all) << "unmasked there before";
  EXPECT_EQ(uncontradicted(wall_with_box(0.0, 1.5F)), all) << "hidden before";
  EXPECT_EQ(uncontradicted(wall_with_box(0.0, 3.0F)), 0U) << "free before";
}

TEST(MaskCheck, BelievesMasksWithoutAView) {
  const MaskCheck check({}, {});
  EXPECT_FALSE(check.has_views());
  const MaskEvidence evidence = check.compare(masked(wall_with_box(0.0, 2.0F)), pose({0, 0, 0}));
  EXPECT_TRUE(evidence.overruled.empty());
  EXPECT_EQ(evidence.masked_agreement, 0.0);
}

TEST(MaskCheck, ComparesFromAnotherPose) {
  const LabeledCloud view = wall_with_box(0.0, 3.0F);
  // 0.5 m nearer, the wall is at 2.5 m.
  LabeledCloud near = organised_cloud([](int, int, const Eigen::Vector3f&) { return 2.5F; });
  near.stamp = at(0.5);
  EXPECT_EQ(count(compare(view, masked(near), {0, 0, 0.5}).overruled),
            static_cast<std::size_t>(kWidth * kHeight));
  EXPECT_TRUE(compare(view, masked(near)).overruled.empty());
}

TEST(MaskCheck, OverrulesThePartOfAMaskOnASurfaceSeenBefore) {
  // The lower half of the mask covers the wall, the upper half somebody before it.
  LabeledCloud cloud = wall_with_box(0.5, 3.0F);
  const LabeledCloud person = wall_with_box(0.5, 1.5F);
  const int half = kTop + kHeight / 2;
  for (int y = 0; y < half; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      cloud.points[i] = person.points[i];
    }
  }
  const LabeledCloud both = masked(cloud);
  const MaskEvidence evidence = compare(wall_with_box(0.0, 3.0F), both);
  std::size_t upper = 0;
  for (int y = 0; y < half; ++y) {
    for (int x = 0; x < cloud.width; ++x) upper += evidence.overruled(x, y);
  }
  EXPECT_EQ(upper, 0U);
  EXPECT_GT(count(evidence.overruled), static_cast<std::size_t>(kWidth * kHeight / 3));
  EXPECT_NEAR(evidence.masked_agreement, 0.5, 0.05);
}

/// A vehicle that moves with the sensor, and a wall beside it, in one cluster under a false mask.
TEST(MaskCheck, BelievesTheMaskOfAnObjectBesideASurfaceUnderOneCluster) {
  const LabeledCloud vehicle = masked(wall_with_box(0.0, 2.0F));
  LabeledCloud cloud = masked(wall_with_box(0.5, 2.0F));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    cloud.labels[i] = PointLabel::kDynamic;
    cloud.cluster[i] = 0;
  }
  const MaskEvidence evidence = compare(vehicle, cloud);
  std::size_t of_wall = 0;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      if (in_box(x, y)) {
        EXPECT_EQ(evidence.overruled(x, y), 0) << x << " " << y;
      } else {
        of_wall += evidence.overruled(x, y);
      }
    }
  }
  EXPECT_GT(of_wall, cloud.points.size() / 2);
}

TEST(MaskCheck, ComparingMaskedPointsAloneGivesTheSame) {
  LabeledCloud cloud = wall_with_box(0.5, 3.0F);
  for (std::size_t i = 0; i < cloud.points.size(); i += 3) cloud.points[i] *= 0.5F;
  cloud = masked(cloud);
  const MaskCheck check = check_with(wall_with_box(0.0, 3.0F));
  const MaskEvidence all = check.compare(cloud, pose({0, 0, 0}), MaskCheck::Points::kAll);
  const MaskEvidence some = check.compare(cloud, pose({0, 0, 0}), MaskCheck::Points::kMasked);
  EXPECT_EQ(all.overruled.pixels(), some.overruled.pixels());
  EXPECT_EQ(all.overruled_share, some.overruled_share);
}

TEST(MaskCheck, RemembersOverruledPointsAsStatic) {
  LabeledCloud view = masked(wall_with_box(0.0, 2.0F));
  view.overruled = Image<std::uint8_t>(view.width, view.height, 1);
  const MaskEvidence evidence = compare(view, masked(wall_with_box(0.5, 2.0F)));
  EXPECT_EQ(count(evidence.overruled), static_cast<std::size_t>(kWidth * kHeight));
}

/// The view does not know the upper half of the box, too little of it for a mask of full weight.
TEST(MaskCheck, OverrulesAMaskOfLowWeightFromLessEvidence) {
  LabeledCloud view = wall_with_box(0.0, 2.0F);
  for (int y = 0; y < kTop + kHeight / 2; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const auto i = static_cast<std::size_t>(y * view.width + x);
      view.points[i].setConstant(NAN);
      view.labels[i] = PointLabel::kInvalid;
    }
  }
  LabeledCloud cloud = masked(wall_with_box(0.5, 2.0F));
  const std::size_t half = static_cast<std::size_t>(kWidth * kHeight / 2);
  EXPECT_LT(count(compare(view, cloud).overruled), half + kWidth * 5);
  cloud.clusters[0].weight = 0.5F;
  EXPECT_EQ(count(compare(view, cloud).overruled), 2 * half);
}

/// Views of the place from positions a meter apart, and none for a while.
TEST(MaskCheck, AsksEarlierViewsOfThePlace) {
  const LabeledCloud cloud = masked(wall_with_box(20.0, 3.0F));
  const auto overruled = [&](std::initializer_list<double> positions) {
    MaskCheck check({}, {});
    double seconds = 0.0;
    for (const double x : positions) {
      check.remember(wall_with_box(seconds, 3.0F), pose({x, 0, 0}));
      seconds += 0.5;
    }
    return count(check.compare(cloud, pose({0, 0, 0})).overruled);
  };
  EXPECT_EQ(overruled({-0.3, 0.3}), static_cast<std::size_t>(kWidth * kHeight));
  EXPECT_EQ(overruled({-0.3}), 0U) << "one view is not enough";
  EXPECT_EQ(overruled({-1.5, 1.5}), 0U) << "too far away";
}

TEST(MaskCheck, ForgetsOldViews) {
  MaskCheckConfig config;
  config.memory = 1.0;
  const MaskCheck check = check_with(wall_with_box(0.0, 2.0F), config);
  const auto overruled = [&](double seconds) {
    return count(check.compare(masked(wall_with_box(seconds, 2.0F)), pose({0, 0, 0})).overruled);
  };
  EXPECT_GT(overruled(0.9), 0U);
  EXPECT_EQ(overruled(1.1), 0U);
}

TEST(MaskCheck, RemembersNothingWhenDisabled) {
  MaskCheckConfig config;
  config.enabled = false;
  EXPECT_FALSE(check_with(wall_with_box(0.0, 2.0F), config).has_views());
}

}  // namespace
}  // namespace mms
