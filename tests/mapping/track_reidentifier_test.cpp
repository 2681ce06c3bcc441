#include "mms/mapping/tracking/track_reidentifier.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "mms/mapping/tracking/dynamic_map.hpp"

namespace mms {
namespace {

constexpr double kPeriod = 0.1;  // [s]
const Rgb kRed{200, 40, 40};
const Rgb kBlue{40, 40, 200};

struct Person {
  double x;
  double y;
  Rgb shirt;
  std::optional<Rgb> vest{};  // over the shirt, but not over its collar
};

Rgb color_at(const Person& person, double height) {
  if (height < 0.9) return {90, 90, 90};
  return height < 1.4 ? person.vest.value_or(person.shirt) : person.shirt;
}

/// A scan in which the persons stand on the floor, in grey trousers; z is up.
LabeledCloud scan_of(const std::vector<Person>& persons, double seconds) {
  LabeledCloud cloud;
  cloud.stamp = Timestamp::from_seconds(1.0 + seconds);
  for (const Person& person : persons) {
    DynamicCluster cluster;
    cluster.instance = static_cast<int>(cloud.clusters.size());
    for (int i = 0; i < 170; ++i) {
      const double height = 0.01 * i;
      const double angle = 2.4 * i;
      cloud.points.push_back(Eigen::Vector3d(person.x + 0.2 * std::cos(angle),
                                             person.y + 0.2 * std::sin(angle), height)
                                 .cast<float>());
      cloud.colors.push_back(color_at(person, height));
      cloud.cluster.push_back(static_cast<std::int16_t>(cluster.instance));
    }
    cloud.clusters.push_back(cluster);
  }
  cloud.labels.assign(cloud.points.size(), PointLabel::kDynamic);
  cloud.width = static_cast<int>(cloud.points.size());
  cloud.height = 1;
  return cloud;
}

/// Updates the map with ten frames of the same persons from time `from` [s] on.
void update(DynamicMap& map, double from, const std::vector<Person>& persons) {
  for (int i = 0; i < 10; ++i) {
    const LabeledCloud cloud = scan_of(persons, from + kPeriod * i);
    OdometryEstimate odometry;
    odometry.stamp = cloud.stamp;
    map.update(cloud, odometry);
  }
}

/// The current ids, in the order of the objects.
std::vector<int> ids(const DynamicMap& map) {
  std::vector<int> ids;
  for (const TrackedObject& object : map.objects()) ids.push_back(object.box.id);
  return ids;
}

/// The camera does not see points with y > 0: their color is black, and they have no mask.
TEST(TrackReidentifier, KeepsIdOfAPersonWhoLeavesTheView) {
  DynamicMap map;
  for (int i = 0; i < 60; ++i) {
    LabeledCloud cloud = scan_of({{4.0, -2.0 + 1.2 * kPeriod * i, kRed}}, kPeriod * i);
    for (std::size_t k = 0; k < cloud.points.size(); ++k) {
      if (cloud.points[k].y() > 0.0F) cloud.colors[k] = Rgb{};
    }
    if (cloud.points.front().y() > 0.0F) {
      cloud.clusters[0].instance = -1;
      cloud.clusters[0].object_class = ObjectClass::kUnknown;
      cloud.clusters[0].score = 0.0;
    }
    OdometryEstimate odometry;
    odometry.stamp = cloud.stamp;
    map.update(cloud, odometry);
  }
  EXPECT_EQ(ids(map), std::vector<int>{1});
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(TrackReidentifier, ReidentifiesByAppearanceElsewhere) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}, {3.0, 2.0, kBlue}});
  update(map, 1.0, {});
  update(map, 8.0, {{5.0, 2.0, kRed}});
  EXPECT_EQ(ids(map), std::vector<int>{1});
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(TrackReidentifier, ReidentifiesWhileTrackCoasts) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}});
  // Unseen for half a second, at a position outside the gate of the prediction.
  update(map, 1.4, {{3.0, -0.5, kRed}});
  EXPECT_EQ(ids(map), std::vector<int>{1});
  EXPECT_EQ(map.objects().at(0).state, TrackState::kActive);
  EXPECT_EQ(map.confirmed(), 1);
}

TEST(TrackReidentifier, OnlyOneOfTwoAlikeContinuesACoastingTrack) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}});
  update(map, 1.4, {{3.0, -0.5, kRed}, {3.0, -3.5, kRed}});
  const std::vector<int> both = ids(map);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_NE(both[0], both[1]);
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(TrackReidentifier, NewIdBesideVisiblePersonOfEqualAppearance) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}});
  update(map, 1.0, {{3.0, -2.0, kRed}, {3.0, -0.5, kRed}});
  EXPECT_EQ(ids(map).size(), 2U);
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(TrackReidentifier, NewIdForDifferentAppearance) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}});
  update(map, 1.0, {});
  update(map, 8.0, {{3.0, -2.0, kBlue}});
  ASSERT_EQ(ids(map).size(), 1U);
  EXPECT_NE(ids(map)[0], 1);
  EXPECT_EQ(map.confirmed(), 2);
}

/// Whether a person who appears that long after the first one left gets the first one's id.
bool is_reidentified(double seconds, const Person& person) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}});
  update(map, 1.0, {});
  update(map, 1.0 + seconds, {person});
  return ids(map) == std::vector<int>{1};
}

TEST(TrackReidentifier, NeedsMoreSimilarityWithTimeAndDistance) {
  EXPECT_TRUE(is_reidentified(2.0, {3.0, -2.0, kRed, kBlue}));
  EXPECT_FALSE(is_reidentified(30.0, {3.0, 3.0, kRed, kBlue}));
  EXPECT_TRUE(is_reidentified(30.0, {3.0, 3.0, kRed}));
}

TEST(TrackReidentifier, NewIdForUnreachablePosition) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}});
  update(map, 1.0, {});
  update(map, 4.0, {{20.0, 10.0, kRed}});
  EXPECT_EQ(map.confirmed(), 2);
}

TEST(TrackReidentifier, NewIdWhenTwoCandidatesAreEqual) {
  DynamicMap map;
  update(map, 0.0, {{3.0, -2.0, kRed}, {3.0, 2.0, kRed}});
  update(map, 1.0, {});
  update(map, 8.0, {{4.0, 0.0, kRed}});
  EXPECT_EQ(map.confirmed(), 3);
}

TEST(TrackReidentifier, ForgetsAfterMaxAway) {
  DynamicMapConfig config;
  config.reidentification.max_away = 5.0;
  DynamicMap map(config);
  update(map, 0.0, {{3.0, -2.0, kRed}});
  update(map, 10.0, {});
  update(map, 12.0, {{3.0, -2.0, kRed}});
  EXPECT_EQ(map.confirmed(), 2);
}

}  // namespace
}  // namespace mms
