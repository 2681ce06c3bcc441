#include "mms/evaluation/map/map_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mms/core/error.hpp"

namespace mms {
namespace {

using Points = std::vector<Eigen::Vector3f>;

const float kNaN = std::nanf("");

TEST(MapError, CountsKeptStaticAndRemovedDynamicPoints) {
  const Points fixed = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  const Points dynamic = {{0, 5, 0}, {1, 5, 0}};
  const Points map = {{0.04F, 0, 0}, {1, 0, 0.049F}, {2, 0.03F, 0}, {3, 0.06F, 0}, {1, 5, 0}};
  const MapError error = evaluate_map(fixed, dynamic, map);
  EXPECT_DOUBLE_EQ(error.SA, 75.0);
  EXPECT_DOUBLE_EQ(error.DA, 50.0);
  EXPECT_DOUBLE_EQ(error.AA, std::sqrt(75.0 * 50.0));
  EXPECT_DOUBLE_EQ(error.HA, 2.0 * 75.0 * 50.0 / 125.0);
}

TEST(MapError, ExcludesDynamicPointsNearStaticPoints) {
  const Points floor = {{0, 0, 0}, {1, 0, 0}};
  const Points person = {{0, 0, 0.03F}, {0, 0, 1.0F}};
  const MapError error = evaluate_map(floor, person, floor);
  EXPECT_EQ(error.ambiguous_points, 1U);
  EXPECT_EQ(error.dynamic_points, 1U);
  EXPECT_DOUBLE_EQ(error.DA, 100.0);
}

TEST(MapError, EmptyMapHasZeroSaAndFullDa) {
  const MapError error = evaluate_map({{0, 0, 0}}, {{1, 0, 0}}, {});
  EXPECT_DOUBLE_EQ(error.SA, 0.0);
  EXPECT_DOUBLE_EQ(error.DA, 100.0);
  EXPECT_DOUBLE_EQ(error.AA, 0.0);
  EXPECT_DOUBLE_EQ(error.HA, 0.0);
}

TEST(MapError, DaIsNanWithoutDynamicPoints) {
  const MapError error = evaluate_map({{0, 0, 0}}, {}, {{0, 0, 0}});
  EXPECT_DOUBLE_EQ(error.SA, 100.0);
  EXPECT_TRUE(std::isnan(error.DA));
  EXPECT_EQ(to_json(metric_values(error)),
            R"({"sa_pct":100.0,"da_pct":null,"aa_pct":null,"ha_pct":null})");
}

TEST(MapError, IgnoresInvalidPoints) {
  const Points invalid = {{kNaN, 0, 0}, {0, INFINITY, 0}, {3e30F, 0, 0}, {0, 0, 0}};
  const MapError error = evaluate_map(invalid, invalid, invalid);
  EXPECT_EQ(error.static_points, 1U);
  EXPECT_EQ(error.ambiguous_points, 1U);
  EXPECT_DOUBLE_EQ(error.SA, 100.0);
}

TEST(MapError, EqualsBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(-0.5F, 0.5F);
  const auto cloud = [&](int count) {
    Points points;
    for (int i = 0; i < count; ++i) {
      points.emplace_back(uniform(random), uniform(random), uniform(random));
    }
    return points;
  };
  const Points truth = cloud(500);
  const Points map = cloud(500);
  const auto kept = std::count_if(truth.begin(), truth.end(), [&](const Eigen::Vector3f& point) {
    return std::any_of(map.begin(), map.end(), [&](const Eigen::Vector3f& other) {
      return (point - other).norm() <= 0.05F;
    });
  });
  EXPECT_DOUBLE_EQ(evaluate_map(truth, {}, map).SA, 100.0 * static_cast<double>(kept) / 500.0);
}

TEST(MapError, RejectsEmptyTruthAndInvalidRadius) {
  EXPECT_THROW(evaluate_map({}, {}, {{0, 0, 0}}), DataError);
  EXPECT_THROW(evaluate_map({{0, 0, 0}}, {}, {}, 0.0), DataError);
  EXPECT_THROW(evaluate_map({{0, 0, 0}}, {}, {}, std::nan("")), DataError);
}

}  // namespace
}  // namespace mms
