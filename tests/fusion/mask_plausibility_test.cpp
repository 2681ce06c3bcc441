#include "mms/fusion/masks/mask_plausibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mms/fusion/clouds/depth_cloud.hpp"
#include "mms/fusion/semantic_fusion.hpp"
#include "tests/fusion/scene.hpp"

namespace mms {
namespace {

using testing::mask_of;
using testing::render;
using testing::room_with_person;
using testing::Scene;
using testing::segmentation_of;
using testing::Surface;
using testing::View;

/// A floor and a wall `distance` [m] away.
Scene room(float distance) {
  return Scene()
      .add(Surface::kFloor, {-10, 1.2F, 0}, {10, 1.3F, 20})
      .add(Surface::kWall, {-10, -5, distance}, {10, 1.2F, distance + 0.1F});
}

/// A rectangle of the image as one instance.
Instance rectangle(int x, int y, int width, int height,
                   ObjectClass object_class = ObjectClass::kPerson) {
  Instance instance;
  instance.object_class = object_class;
  instance.x = x;
  instance.y = y;
  instance.mask = Image<std::uint8_t>(width, height, 1);
  return instance;
}

LabeledCloud fuse(const View& view, const Instance& instance, bool plausibility = true) {
  FusionConfig config;
  config.plausibility = plausibility;
  return SemanticFusion(config).fuse(view.frame, segmentation_of(view, {instance}));
}

int implausible(const View& view, const Instance& instance) {
  return fuse(view, instance).implausible_masks;
}

/// The image's central part with half of its sides.
Instance center(const View& view, ObjectClass object_class = ObjectClass::kPerson) {
  const int width = view.frame.depth.width();
  const int height = view.frame.depth.height();
  return rectangle(width / 4, height / 4, width / 2, height / 2, object_class);
}

TEST(MaskPlausibility, DropsAPersonThatIsAWall) {
  const View view = render(room(2.0F));
  const LabeledCloud cloud = fuse(view, center(view));
  EXPECT_EQ(cloud.implausible_masks, 1);
  EXPECT_EQ(std::count(cloud.labels.begin(), cloud.labels.end(), PointLabel::kDynamic), 0);
  EXPECT_EQ(fuse(view, center(view), false).implausible_masks, 0);
}

TEST(MaskPlausibility, DropsAPersonThatIsATable) {
  const View view =
      render(room(4.0F).add(Surface::kDesk, {-0.8F, 0.5F, 1.0F}, {0.8F, 0.55F, 2.0F}));
  EXPECT_EQ(implausible(view, mask_of(view, Surface::kDesk)), 1);
}

TEST(MaskPlausibility, KeepsAPerson) {
  const View view = render(room_with_person());
  EXPECT_EQ(implausible(view, mask_of(view, Surface::kPerson)), 0);
  EXPECT_EQ(implausible(view, mask_of(view, Surface::kPerson, 6)), 0);
}

TEST(MaskPlausibility, KeepsAPersonAtArmsLength) {
  const View view =
      render(room(4.0F).add(Surface::kPerson, {-0.25F, -0.3F, 0.6F}, {0.25F, 1.2F, 0.9F}));
  EXPECT_EQ(implausible(view, mask_of(view, Surface::kPerson)), 0);
}

TEST(MaskPlausibility, KeepsPeopleSideBySideUnderOneMask) {
  Scene scene = room(4.0F);
  for (int i = -2; i <= 2; ++i) {
    const auto x = 0.6F * static_cast<float>(i);
    const float z = 2.0F + 0.3F * static_cast<float>(i % 2);
    scene.add(Surface::kPerson, {x - 0.25F, -0.5F, z}, {x + 0.25F, 1.2F, z + 0.3F});
  }
  const View view = render(scene);
  EXPECT_EQ(implausible(view, mask_of(view, Surface::kPerson)), 0);
}

/// Depth images of a wall with people before it: torsos of 38 x 24 cm with heads, arms and legs.
View people_abreast(int people, float distance) {
  View view = render(room(5.0F));
  const CameraIntrinsics camera = *view.frame.calibration->camera;
  struct Limb {
    float x, top, bottom, half_width, half_depth;
  };
  constexpr Limb kLimbs[] = {
      {0.0F, -0.5F, -0.25F, 0.08F, 0.1F},  {0.0F, -0.25F, 0.35F, 0.19F, 0.12F},
      {-0.24F, -0.2F, 0.4F, 0.05F, 0.05F}, {0.24F, -0.2F, 0.4F, 0.05F, 0.05F},
      {-0.1F, 0.35F, 1.2F, 0.08F, 0.08F},  {0.1F, 0.35F, 1.2F, 0.08F, 0.08F}};
  for (int v = 0; v < view.truth.height(); ++v) {
    for (int u = 0; u < view.truth.width(); ++u) {
      const float rx =
          (static_cast<float>(u) - static_cast<float>(camera.cx)) / static_cast<float>(camera.fx);
      const float ry =
          (static_cast<float>(v) - static_cast<float>(camera.cy)) / static_cast<float>(camera.fy);
      for (int i = 0; i < people; ++i) {
        const float center =
            0.58F * (static_cast<float>(i) - 0.5F * static_cast<float>(people - 1));
        for (const Limb& limb : kLimbs) {
          const float y = distance * ry;
          const float across = (distance * rx - center - limb.x) / limb.half_width;
          if (y < limb.top || y > limb.bottom || std::abs(across) > 1.0F) continue;
          const float z = distance - limb.half_depth * std::sqrt(1.0F - across * across);
          if (z >= view.frame.depth(u, v)) continue;
          view.frame.depth(u, v) = z;
          view.truth(u, v) = Surface::kPerson;
        }
      }
    }
  }
  return view;
}

TEST(MaskPlausibility, KeepsPeopleAbreastUnderOneMask) {
  for (const float distance : {2.5F, 2.8F, 2.9F, 3.1F}) {
    for (const int people : {2, 3}) {
      const View view = people_abreast(people, distance);
      EXPECT_EQ(implausible(view, mask_of(view, Surface::kPerson)), 0) << people << " " << distance;
    }
  }
}

TEST(MaskPlausibility, KeepsTheFlatSideOfAVehicle) {
  const View view = render(room(2.0F));
  EXPECT_EQ(implausible(view, center(view, ObjectClass::kAgv)), 0);
}

TEST(MaskPlausibility, DropsAPersonLargerThanARoom) {
  // Too far to tell whether it is flat.
  const View view = render(room(8.0F));
  Instance all = center(view);
  all.y = 0;
  all.mask = Image<std::uint8_t>(all.mask.width(), view.frame.depth.height() / 2, 1);
  EXPECT_EQ(implausible(view, all), 1);
}

TEST(MaskPlausibility, KeepsAMaskWithFewPoints) {
  View view = render(room(2.0F));
  for (float& depth : view.frame.depth.pixels()) depth = 0.0F;
  EXPECT_EQ(implausible(view, center(view)), 0);
}

/// The verdict on one mask.
Plausibility judged(const View& view, const Instance& instance) {
  const FusionConfig config;
  const LabeledCloud cloud = DepthCloudBuilder(config).build(view.frame);
  const Segmentation segmentation = segmentation_of(view, {instance});
  const MaskImage mask =
      make_mask_image(segmentation, segmentation.width, segmentation.height,
                      config.stride_of(*view.frame.calibration->camera), config.dilation);
  return judge_masks(cloud, mask.raw.pixels(), segmentation.instances, config).front();
}

TEST(MaskPlausibility, DoubtsAWallTooFarToBeSure) {
  const View near = render(room(2.0F));
  const View far = render(room(4.0F));
  EXPECT_EQ(judged(near, center(near)), Plausibility::kImpossible);
  Instance part = center(far);
  part.mask = Image<std::uint8_t>(part.mask.width(), part.mask.height() / 2, 1);
  EXPECT_EQ(judged(far, part), Plausibility::kDoubtful);
}

TEST(MaskPlausibility, DoesNotDoubtAPerson) {
  const View view = render(room_with_person());
  const LabeledCloud cloud = fuse(view, mask_of(view, Surface::kPerson));
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].weight, 1.0F);
}

TEST(MaskPlausibility, DoubtsAMaskWithFewReturns) {
  View view = render(room_with_person());
  for (std::size_t i = 0; i < view.truth.size(); ++i) {
    const auto row = static_cast<int>(i) / view.truth.width();
    if (view.truth[i] == Surface::kPerson && row % 8 < 6) view.frame.depth[i] = 0.0F;
  }
  const LabeledCloud cloud = fuse(view, mask_of(view, Surface::kPerson));
  ASSERT_FALSE(cloud.clusters.empty());
  EXPECT_LT(cloud.clusters[0].weight, 1.0F);
}

TEST(MaskPlausibility, ClearsOnlyTheImplausibleMask) {
  const View view =
      render(room_with_person(0.6F).add(Surface::kDesk, {-1.0F, 0.5F, 1.0F}, {0.5F, 0.55F, 2.0F}));
  FusionConfig config;
  const LabeledCloud cloud = SemanticFusion(config).fuse(
      view.frame,
      segmentation_of(view, {mask_of(view, Surface::kDesk), mask_of(view, Surface::kPerson)}));
  EXPECT_EQ(cloud.implausible_masks, 1);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_NEAR(cloud.clusters[0].centroid.x(), 0.85F, 0.1F);
}

TEST(MaskPlausibility, KeepsAPersonUnderAnImplausibleMask) {
  const View view =
      render(room(3.0F).add(Surface::kPerson, {-0.25F, -0.5F, 2.7F}, {0.25F, 0.9F, 2.85F}));
  Instance person = mask_of(view, Surface::kPerson);
  person.score = 0.5F;  // the wall has 1
  const Instance wall = rectangle(0, 0, view.frame.depth.width(), 452);
  const LabeledCloud cloud =
      SemanticFusion(FusionConfig{}).fuse(view.frame, segmentation_of(view, {wall, person}));
  EXPECT_EQ(cloud.implausible_masks, 1);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].instance, 1);
}

}  // namespace
}  // namespace mms
