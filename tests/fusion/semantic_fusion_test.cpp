#include "mms/fusion/semantic_fusion.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "mms/core/error.hpp"
#include "tests/fusion/scene.hpp"

namespace mms {
namespace {

using testing::mask_of;
using testing::render;
using testing::room;
using testing::room_with_person;
using testing::segmentation_of;
using testing::Surface;
using testing::View;

LabeledCloud fuse(const View& view, std::vector<Instance> instances,
                  FusionMode mode = FusionMode::kMultimodal) {
  FusionConfig config;
  config.mode = mode;
  return SemanticFusion(config).fuse(view.frame, segmentation_of(view, std::move(instances)));
}

/// Share of dynamic points among those whose whole block shows `surface`.
double dynamic_share_of(const LabeledCloud& cloud, const View& view, Surface surface) {
  int count = 0;
  int dynamic = 0;
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const auto i = static_cast<std::size_t>(y * cloud.width + x);
      const bool is_surface =
          view.truth(2 * x, 2 * y) == surface && view.truth(2 * x + 1, 2 * y) == surface &&
          view.truth(2 * x, 2 * y + 1) == surface && view.truth(2 * x + 1, 2 * y + 1) == surface;
      if (!is_surface) continue;
      ++count;
      dynamic += cloud.labels[i] == PointLabel::kDynamic;
    }
  }
  return count == 0 ? 0.0 : static_cast<double>(dynamic) / count;
}

void expect_only_person(const LabeledCloud& cloud, const View& view) {
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.002);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kFloor), 0.01);
}

TEST(SemanticFusion, ExactMaskLabelsOnlyPersonDynamic) {
  const View view = render(room_with_person());
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)});
  expect_only_person(cloud, view);
  ASSERT_EQ(cloud.clusters.size(), 1U);
  const DynamicCluster& person = cloud.clusters[0];
  EXPECT_EQ(person.object_class, ObjectClass::kPerson);
  EXPECT_NEAR(person.box_min.x(), -0.25F, 0.03F);
  EXPECT_NEAR(person.box_max.x(), 0.25F, 0.03F);
  EXPECT_NEAR(person.box_min.y(), -0.5F, 0.06F);
  EXPECT_NEAR(person.centroid.z(), 2.5F, 0.05F);
  EXPECT_GT(person.points, 9000);
}

TEST(SemanticFusion, HalfMaskLabelsWholePersonDynamic) {
  const View view = render(room_with_person());
  Instance half = mask_of(view, Surface::kPerson);
  for (int y = 307; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) half.mask(x, y) = 0;
  }
  expect_only_person(fuse(view, {half}), view);
}

TEST(SemanticFusion, CompletesErodedMaskByGeometry) {
  const View view = render(room_with_person());
  expect_only_person(fuse(view, {mask_of(view, Surface::kPerson, -15)}), view);
}

TEST(SemanticFusion, RestoresWallUnderDilatedMask) {
  const View view = render(room_with_person());
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson, 20)});
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.001);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kFloor), 0.03);
}

TEST(SemanticFusion, AllStaticWithoutMasks) {
  const View view = render(room_with_person());
  const LabeledCloud cloud = fuse(view, {});
  EXPECT_EQ(dynamic_share(cloud), 0.0);
  EXPECT_TRUE(cloud.clusters.empty());
}

/// View of a person at time `seconds`, the left side at `x` [m].
View person_at(double seconds, float x) {
  View view = render(room_with_person(x));
  view.frame.stamp = Timestamp(static_cast<std::int64_t>(seconds * 1e9));
  return view;
}

TEST(SemanticFusion, RemembersLostMaskForHalfASecond) {
  SemanticFusion fusion{FusionConfig{}};
  for (int i = -8; i <= 0; ++i) {
    const View masked = person_at(10.0 + i / 15.0, -0.25F);
    fusion.fuse(masked.frame, segmentation_of(masked, {mask_of(masked, Surface::kPerson)}));
  }
  for (int i = 1; i <= 7; ++i) {
    const View view = person_at(10.0 + i / 15.0, -0.25F + 0.1F * static_cast<float>(i));
    const LabeledCloud cloud = fusion.fuse(view.frame, segmentation_of(view, {}));
    EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.975);  // without the soles
    EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.002);
    EXPECT_LT(dynamic_share_of(cloud, view, Surface::kFloor), 0.01);
    ASSERT_EQ(cloud.clusters.size(), 1U);
    EXPECT_EQ(cloud.clusters[0].object_class, ObjectClass::kPerson);
  }
  const View late = person_at(10.6, 0.6F);
  EXPECT_EQ(dynamic_share(fusion.fuse(late.frame, segmentation_of(late, {}))), 0.0);
}

TEST(SemanticFusion, RemembersLostMaskForAsLongAsItWasThereAndOneFrame) {
  for (const int masked_frames : {1, 3}) {
    SemanticFusion fusion{FusionConfig{}};
    for (int i = 0; i < masked_frames; ++i) {
      const View masked = person_at(10.0 + i / 15.0, -0.25F);
      fusion.fuse(masked.frame, segmentation_of(masked, {mask_of(masked, Surface::kPerson)}));
    }
    for (int i = masked_frames; i <= 2 * masked_frames; ++i) {
      const View view = person_at(10.0 + i / 15.0, -0.25F);
      const double share = dynamic_share(fusion.fuse(view.frame, segmentation_of(view, {})));
      EXPECT_EQ(share > 0.0, i < 2 * masked_frames) << i << " of " << masked_frames;
    }
  }
}

TEST(SemanticFusion, RemembersMasksWhereNoneWereComputed) {
  SemanticFusion fusion{FusionConfig{}};
  const View masked = person_at(10.0, -0.25F);
  fusion.fuse(masked.frame, segmentation_of(masked, {mask_of(masked, Surface::kPerson)}));
  for (int i = 1; i <= 7; ++i) {
    const View view = person_at(10.0 + i / 15.0, -0.25F);
    EXPECT_GT(dynamic_share(fusion.fuse(view.frame, Segmentation{})), 0.0) << i;
  }
}

TEST(SemanticFusion, SaysHowLongAnObjectWasFollowed) {
  SemanticFusion fusion{FusionConfig{}};
  for (int i = 0; i <= 6; ++i) {
    const View view = person_at(10.0 + i / 15.0, -0.25F + 0.05F * static_cast<float>(i));
    // A frame without masks does not interrupt it.
    const bool has_mask = i != 3;
    const LabeledCloud cloud = fusion.fuse(
        view.frame, segmentation_of(view, has_mask ? std::vector{mask_of(view, Surface::kPerson)}
                                                   : std::vector<Instance>{}));
    ASSERT_EQ(cloud.clusters.size(), 1U);
    EXPECT_NEAR(cloud.clusters[0].followed, i / 15.0, 1e-6);
  }
  const View elsewhere = person_at(10.5, -2.0F);
  const LabeledCloud cloud = fusion.fuse(
      elsewhere.frame, segmentation_of(elsewhere, {mask_of(elsewhere, Surface::kPerson)}));
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_EQ(cloud.clusters[0].followed, 0.0);
}

TEST(SemanticFusion, RemembersNothingWherePersonLeft) {
  SemanticFusion fusion{FusionConfig{}};
  const View masked = person_at(10.0, -0.25F);
  fusion.fuse(masked.frame, segmentation_of(masked, {mask_of(masked, Surface::kPerson)}));
  View empty = render(room());
  empty.frame.stamp = Timestamp(10'066'000'000);
  EXPECT_EQ(dynamic_share(fusion.fuse(empty.frame, segmentation_of(empty, {}))), 0.0);
}

TEST(SemanticFusion, VisionModeRemembersNoMasks) {
  FusionConfig config;
  config.mode = FusionMode::kVision;
  SemanticFusion fusion{config};
  const View masked = person_at(10.0, -0.25F);
  fusion.fuse(masked.frame, segmentation_of(masked, {mask_of(masked, Surface::kPerson)}));
  const View view = person_at(10.066, -0.25F);
  EXPECT_EQ(dynamic_share(fusion.fuse(view.frame, segmentation_of(view, {}))), 0.0);
}

TEST(SemanticFusion, SeparatesObjectsWithOverlappingMasks) {
  auto scene = room_with_person();
  scene.add(Surface::kOther, {0.1F, -0.6F, 3.0F}, {0.6F, 1.2F, 3.3F});
  const View view = render(scene);
  Instance front = mask_of(view, Surface::kPerson, 6);
  Instance back = mask_of(view, Surface::kOther, 6);
  const LabeledCloud cloud = fuse(view, {front, back});
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kOther), 0.985);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kWall), 0.002);
  EXPECT_EQ(cloud.clusters.size(), 2U);
}

TEST(SemanticFusion, KeepsWallBehindLeaningPersonStatic) {
  const View view =
      render(room().add(Surface::kPerson, {-0.25F, -0.5F, 3.7F}, {0.25F, 1.2F, 4.0F}));
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)});
  expect_only_person(cloud, view);
}

TEST(SemanticFusion, RestoresDeskUnderDilatedMask) {
  auto scene = room_with_person();
  scene.add(Surface::kDesk, {-0.8F, 0.4F, 3.1F}, {1.0F, 1.2F, 3.6F});
  const View view = render(scene);
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson, 10)});
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kDesk), 0.002);
}

TEST(SemanticFusion, SeparatesFlatSideCoplanarWithRack) {
  auto scene = room();
  scene.add(Surface::kDesk, {-2.0F, -1.0F, 3.0F}, {-0.6F, 1.2F, 3.3F});
  scene.add(Surface::kPerson, {0.0F, 0.2F, 3.0F}, {0.8F, 1.1F, 3.6F});
  const View view = render(scene);
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)});
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kDesk), 0.002);
}

TEST(SemanticFusion, LabelsTooSmallClustersByMask) {
  const auto scene = room().add(Surface::kPerson, {0.5F, -0.6F, 2.0F}, {0.54F, -0.56F, 2.04F});
  const View view = render(scene);
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)});
  EXPECT_EQ(dynamic_share_of(cloud, view, Surface::kPerson), 1.0);
  EXPECT_EQ(dynamic_share_of(cloud, view, Surface::kWall), 0.0);
  EXPECT_TRUE(cloud.clusters.empty());
}

TEST(SemanticFusion, SplitsPersonFromTouchingFurniture) {
  auto scene = room_with_person();
  // Shelf boards, each too low for a plane of its own, that touch the person's side.
  for (int k = 0; k < 6; ++k) {
    const float y = -0.4F + 0.25F * static_cast<float>(k);
    const float z = k % 2 == 0 ? 2.55F : 2.62F;
    scene.add(Surface::kDesk, {0.25F, y, z}, {1.4F, y + 0.22F, z + 0.2F});
  }
  const View view = render(scene);
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)});
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_LT(dynamic_share_of(cloud, view, Surface::kDesk), 0.2);
}

/// The rows of a mask from `begin` on, `count` of them.
Instance rows_of(const Instance& whole, int begin, int count) {
  Instance part = whole;
  part.y = whole.y + begin;
  part.mask = Image<std::uint8_t>(whole.mask.width(), count);
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < whole.mask.width(); ++x) part.mask(x, y) = whole.mask(x, begin + y);
  }
  return part;
}

TEST(SemanticFusion, TouchingPersonsAreTwoObjects) {
  testing::Scene scene = room_with_person(-0.5F);
  scene.add(Surface::kOther, {0.0F, -0.5F, 2.5F}, {0.5F, 1.2F, 2.8F});
  const View view = render(scene);
  const LabeledCloud cloud =
      fuse(view, {mask_of(view, Surface::kPerson), mask_of(view, Surface::kOther, -3)});
  ASSERT_EQ(cloud.clusters.size(), 2U);
  const bool first_is_left = cloud.clusters[0].centroid.x() < 0.0F;
  EXPECT_NEAR(cloud.clusters[first_is_left ? 0 : 1].centroid.x(), -0.25F, 0.05F);
  EXPECT_NEAR(cloud.clusters[first_is_left ? 1 : 0].centroid.x(), 0.25F, 0.05F);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kPerson), 0.985);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kOther), 0.985);
}

TEST(SemanticFusion, TwoMasksOnOnePersonAreOneObject) {
  const View view = render(room_with_person());
  const Instance whole = mask_of(view, Surface::kPerson);
  const int half = whole.mask.height() / 2;
  const LabeledCloud cloud =
      fuse(view, {rows_of(whole, 0, half), rows_of(whole, half, whole.mask.height() - half)});
  EXPECT_EQ(cloud.clusters.size(), 1U);
  expect_only_person(cloud, view);
}

TEST(SemanticFusion, JoinsVehicleAcrossOcclusion) {
  testing::Scene scene = room();
  scene.add(Surface::kPerson, {-0.8F, 0.4F, 3.0F}, {0.8F, 1.2F, 3.4F});
  scene.add(Surface::kOther, {-0.1F, -1.0F, 2.0F}, {0.1F, 1.2F, 2.2F});
  const View view = render(scene);
  Instance vehicle = mask_of(view, Surface::kPerson);
  vehicle.object_class = ObjectClass::kAgv;
  const LabeledCloud cloud = fuse(view, {vehicle});
  ASSERT_EQ(cloud.clusters.size(), 1U);
  EXPECT_NEAR(cloud.clusters[0].box_max.x() - cloud.clusters[0].box_min.x(), 1.6F, 0.1F);
}

TEST(SemanticFusion, JoinsForkliftMastToBody) {
  testing::Scene scene = room();
  scene.add(Surface::kPerson, {-0.5F, 0.4F, 2.2F}, {0.5F, 1.2F, 2.5F});
  scene.add(Surface::kPerson, {-0.3F, -0.7F, 3.3F}, {0.3F, 0.4F, 3.4F});
  const View view = render(scene);
  Instance vehicle = mask_of(view, Surface::kPerson);
  vehicle.object_class = ObjectClass::kAgv;
  EXPECT_EQ(fuse(view, {vehicle}).clusters.size(), 1U);
}

TEST(SemanticFusion, DoesNotJoinDistantBackgroundToVehicle) {
  testing::Scene scene = room();
  scene.add(Surface::kPerson, {-0.2F, 0.8F, 2.5F}, {0.2F, 1.2F, 2.8F});
  scene.add(Surface::kPerson, {0.4F, 0.8F, 3.6F}, {0.7F, 1.2F, 3.8F});
  const View view = render(scene);
  Instance vehicle = mask_of(view, Surface::kPerson);
  vehicle.object_class = ObjectClass::kAgv;
  const LabeledCloud cloud = fuse(view, {vehicle});
  ASSERT_EQ(cloud.clusters.size(), 2U);
  EXPECT_LT(cloud.clusters[0].box_max.z(), 2.9F);
  EXPECT_GT(cloud.clusters[1].box_min.z(), 3.5F);
}

TEST(SemanticFusion, VisionModeUsesDilatedMaskUnchanged) {
  const View view = render(room_with_person());
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)}, FusionMode::kVision);
  EXPECT_EQ(dynamic_share_of(cloud, view, Surface::kPerson), 1.0);
  EXPECT_GT(dynamic_share_of(cloud, view, Surface::kWall), 0.005);
  EXPECT_EQ(cloud.clusters.size(), 1U);
}

TEST(SemanticFusion, NoneModeIgnoresMask) {
  const View view = render(room_with_person());
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)}, FusionMode::kNone);
  EXPECT_EQ(dynamic_share(cloud), 0.0);
}

TEST(SemanticFusion, MaskedPixelsWithoutReturnAreDynamic) {
  View view = render(room_with_person());
  for (int y = 200; y < 220; ++y) {
    for (int x = 310; x < 330; ++x) view.frame.depth(x, y) = 0.0F;
  }
  view.frame.depth(20, 20) = view.frame.depth(21, 20) = 0.0F;
  view.frame.depth(20, 21) = view.frame.depth(21, 21) = std::numeric_limits<float>::infinity();
  const LabeledCloud cloud = fuse(view, {mask_of(view, Surface::kPerson)});
  EXPECT_NE(cloud.dynamic_pixels(160, 105), 0);
  EXPECT_EQ(cloud.dynamic_pixels(10, 10), 0);
  const auto corner = static_cast<std::size_t>(10 * cloud.width + 10);
  EXPECT_EQ(cloud.labels[corner], PointLabel::kInvalid);
  EXPECT_TRUE(cloud.points[corner].hasNaN());
}

TEST(SemanticFusion, NoDynamicPointsWithoutReturns) {
  View view = render(room_with_person());
  const Instance mask = mask_of(view, Surface::kPerson);
  view.frame.depth = Image<float>(640, 480, std::numeric_limits<float>::quiet_NaN());
  const LabeledCloud cloud = fuse(view, {mask});
  EXPECT_EQ(dynamic_share(cloud), 0.0);
  EXPECT_TRUE(cloud.clusters.empty());
}

TEST(SemanticFusion, ErrorNamesDifferentSizes) {
  const View view = render(room());
  SemanticFusion fusion{FusionConfig{}};
  try {
    fusion.fuse(view.frame, {320, 240, {}});
    FAIL() << "accepted masks of another size";
  } catch (const DataError& error) {
    EXPECT_NE(std::strstr(error.what(), "320 x 240"), nullptr) << error.what();
    EXPECT_NE(std::strstr(error.what(), "640 x 480"), nullptr) << error.what();
  }
}

TEST(SemanticFusion, IsDeterministic) {
  const View view = render(room_with_person());
  const Instance mask = mask_of(view, Surface::kPerson, -8);
  const LabeledCloud a = fuse(view, {mask});
  const LabeledCloud b = fuse(view, {mask});
  EXPECT_EQ(a.labels, b.labels);
  EXPECT_EQ(a.cluster, b.cluster);
  ASSERT_EQ(a.clusters.size(), b.clusters.size());
  EXPECT_EQ(a.clusters[0].centroid, b.clusters[0].centroid);
  EXPECT_EQ(a.clusters[0].box_max, b.clusters[0].box_max);
}

}  // namespace
}  // namespace mms
