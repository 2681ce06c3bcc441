#include "mms/mapping/static_map/semantic_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mms {
namespace {

constexpr double kSpacing = 0.05;

ObjectBox object(int id, ObjectClass object_class, const Eigen::Vector3d& center) {
  ObjectBox box;
  box.id = id;
  box.object_class = object_class;
  box.T_world_box.translation() = center;
  box.size = {1.0, 0.5, 2.0};
  return box;
}

MapCloud one_point() {
  MapCloud map;
  map.points = {{7.0F, 7.0F, 7.0F}};
  map.colors = {{1, 2, 3}};
  map.normals = {Eigen::Vector3f::UnitX()};
  map.observations = {4};
  return map;
}

TEST(SemanticMap, EqualsMapWithoutObjects) {
  const MapCloud map = semantic_map(one_point(), {}, kSpacing);
  EXPECT_EQ(map.points, one_point().points);
  EXPECT_EQ(map.observations, one_point().observations);
}

TEST(SemanticMap, DrawsTwelveEdgesOfBox) {
  const ObjectHistory history = {{Timestamp(1), {object(1, ObjectClass::kAgv, {0, 0, 1})}}};
  const MapCloud map = semantic_map(one_point(), history, kSpacing);
  // 4 edges of each length, with a point more than steps.
  EXPECT_EQ(map.points.size(), 1U + 4 * (21 + 11 + 41));
  EXPECT_EQ(map.colors.size(), map.points.size());
  EXPECT_EQ(map.normals.size(), map.points.size());
  EXPECT_EQ(map.observations.size(), map.points.size());
  for (std::size_t i = 1; i < map.points.size(); ++i) {
    const Eigen::Array3f offset = map.points[i].array() - Eigen::Array3f(0, 0, 1);
    const Eigen::Array3f half(0.5F, 0.25F, 1.0F);
    EXPECT_TRUE((offset.abs() <= half + 1e-5F).all());
    EXPECT_GE((offset.abs() >= half - 1e-5F).count(), 2);  // on an edge
    EXPECT_GT(map.colors[i].g, map.colors[i].r);
  }
}

TEST(SemanticMap, UnknownClassIsAmber) {
  const ObjectHistory history = {{Timestamp(1), {object(1, ObjectClass::kUnknown, {0, 0, 1})}}};
  const MapCloud map = semantic_map({}, history, kSpacing);
  ASSERT_FALSE(map.colors.empty());
  EXPECT_TRUE(std::all_of(map.colors.begin(), map.colors.end(),
                          [](Rgb c) { return c.r > c.g && c.g > 2 * c.b; }));
}

TEST(SemanticMap, TrajectoryIsOnFloorUpToLastBox) {
  ObjectHistory history;
  for (int i = 0; i < 5; ++i) {
    history.push_back({Timestamp(i), {object(3, ObjectClass::kPerson, {0.5 * i, 0, 1})}});
  }
  const MapCloud map = semantic_map({}, history, kSpacing);
  const auto on_trajectory =
      std::count_if(map.points.begin(), map.points.end(), [](const Eigen::Vector3f& p) {
        return p.x() < 1.4F && std::abs(p.y()) < 1e-5F && std::abs(p.z()) < 1e-5F;
      });
  EXPECT_GE(on_trajectory, 28);
  EXPECT_TRUE(std::all_of(map.points.begin(), map.points.end(),
                          [](const Eigen::Vector3f& p) { return p.x() < 2.6F; }));
  EXPECT_TRUE(std::all_of(map.colors.begin(), map.colors.end(), [](Rgb c) { return c.r > c.g; }));
}

TEST(SemanticMap, TrajectoryHasGapWithoutObservations) {
  ObjectHistory history;
  for (const int second : {0, 2}) {
    history.push_back({Timestamp(second * 1'000'000'000LL),
                       {object(3, ObjectClass::kPerson, {3.0 * second, 0, 1})}});
  }
  const MapCloud map = semantic_map({}, history, kSpacing);
  EXPECT_TRUE(std::all_of(map.points.begin(), map.points.end(),
                          [](const Eigen::Vector3f& p) { return p.x() > 5.0F; }));
}

}  // namespace
}  // namespace mms
