#include "mms/localization/registration/data_association.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/localization/box_room.hpp"

namespace mms {
namespace {

const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();
constexpr double kVoxel = 0.2;
constexpr double kGate = 0.4;

FeatureCloud one_edge(const Eigen::Vector3f& point) {
  FeatureCloud features;
  features.edges.push_back({point, 0.003F});
  return features;
}

FeatureCloud one_plane(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  FeatureCloud features;
  features.planes.push_back({point, normal, 0.003F});
  return features;
}

LocalMaps map_of(const FeatureCloud& features, Association association) {
  LocalMaps maps(kVoxel, 100000);
  maps.insert(features, kOrigin, association);
  return maps;
}

/// By rounding, the variance across a line of exact points can be below zero.
TEST(DataAssociation, LineOfExactPointsHasFiniteSpread) {
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f begin(0.5F + 0.013F * static_cast<float>(i), 0.37F, 1.93F);
    FeatureCloud edge;
    for (int k = 0; k < 8; ++k) {
      edge.edges.push_back(
          {begin + static_cast<float>(k) * Eigen::Vector3f(0.0F, 0.05F, 0.02F), 0.003F});
    }
    const LocalMaps maps = map_of(edge, Association::kSurface);
    for (const EdgeMatch& match :
         associate(edge, maps, kOrigin, Association::kSurface, kGate).edges) {
      EXPECT_TRUE(std::isfinite(match.sigma)) << i;
    }
  }
}

class AssociatedBy : public ::testing::TestWithParam<Association> {};
INSTANTIATE_TEST_SUITE_P(Association, AssociatedBy,
                         ::testing::Values(Association::kPaper, Association::kSurface),
                         testing::association_name);

TEST_P(AssociatedBy, MatchesFeaturesWithTheirFaceOrCrease) {
  const testing::BoxRoom room;
  const LocalMaps maps = map_of(exact_features(room, kOrigin, 120), GetParam());
  const Eigen::Isometry3d truth = testing::motion(0.1, 0.05, -0.1, 0.02, 0.01, -0.02);
  const FeatureCloud frame = exact_features(room, truth, 17, kGate);
  const Matches matches = associate(frame, maps, truth, GetParam(), kGate);
  // The paper's association rejects nearly collinear triples of points.
  const std::size_t least = GetParam() == Association::kPaper ? 6 : 9;
  EXPECT_GT(matches.planes.size(), frame.planes.size() * least / 10);
  EXPECT_GT(matches.edges.size(), frame.edges.size() * 9 / 10);
  for (const PlaneMatch& m : matches.planes) {
    EXPECT_NEAR(m.normal.norm(), 1.0, 1e-5);
    EXPECT_NEAR(m.normal.dot(truth * m.point - m.on_plane), 0.0, 1e-3);
    EXPECT_NEAR(m.normal.cwiseAbs().maxCoeff(), 1.0, 1e-3);
  }
  for (const EdgeMatch& m : matches.edges) {
    const Eigen::Vector3d offset = truth * m.point - m.on_line;
    EXPECT_NEAR(m.direction.norm(), 1.0, 1e-5);
    EXPECT_LT((offset - m.direction * m.direction.dot(offset)).norm(), 1e-3);
  }
}

TEST_P(AssociatedBy, RejectsMatchesBeyondGate) {
  const testing::BoxRoom room;
  const LocalMaps maps = map_of(exact_features(room, kOrigin, 40), GetParam());
  const Eigen::Isometry3d far = testing::motion(20.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  const Matches matches = associate(exact_features(room, kOrigin), maps, far, GetParam(), kGate);
  EXPECT_TRUE(matches.planes.empty());
  EXPECT_TRUE(matches.edges.empty());
}

TEST(PaperAssociation, RejectsCoincidentEdgePoints) {
  FeatureCloud map;
  map.edges = {{{1.0F, 0.0F, 2.199F}, 0.01F}, {{1.0F, 0.0F, 2.201F}, 0.01F}};  // 2 voxels
  const LocalMaps close = map_of(map, Association::kPaper);
  ASSERT_EQ(close.edges.size(), 2U);
  EXPECT_TRUE(associate(one_edge({1.0F, 0.1F, 2.2F}), close, kOrigin, Association::kPaper, kGate)
                  .edges.empty());
  map.edges[1].point.z() = 2.4F;
  EXPECT_EQ(associate(one_edge({1.0F, 0.1F, 2.2F}), map_of(map, Association::kPaper), kOrigin,
                      Association::kPaper, kGate)
                .edges.size(),
            1U);
}

TEST(PaperAssociation, RejectsCollinearPlanePoints) {
  const Eigen::Vector3f normal(0.0F, 0.0F, -1.0F);
  FeatureCloud map;
  for (const float x : {0.0F, 0.1F, 0.2F}) map.planes.push_back({{x, 0.0F, 2.0F}, normal, 0.01F});
  const FeatureCloud query = one_plane({0.1F, 0.02F, 2.01F}, normal);
  EXPECT_TRUE(
      associate(query, map_of(map, Association::kPaper), kOrigin, Association::kPaper, kGate)
          .planes.empty());
  map.planes[1].point.y() = 0.15F;
  EXPECT_EQ(associate(query, map_of(map, Association::kPaper), kOrigin, Association::kPaper, kGate)
                .planes.size(),
            1U);
}

TEST(SurfaceAssociation, RejectsOppositeNormals) {
  FeatureCloud map;
  map.planes.push_back({{0.0F, 0.0F, 2.05F}, {0.0F, 0.0F, -1.0F}, 0.01F});
  const LocalMaps maps = map_of(map, Association::kSurface);
  const auto matched = [&](const Eigen::Vector3f& normal) {
    return associate(one_plane({0.0F, 0.0F, 2.06F}, normal), maps, kOrigin, Association::kSurface,
                     kGate)
        .planes.size();
  };
  EXPECT_EQ(matched({0.0F, 0.0F, -1.0F}), 1U);
  EXPECT_EQ(matched({0.0F, 0.0F, 1.0F}), 0U);
  EXPECT_EQ(matched({1.0F, 0.0F, 0.0F}), 0U);
}

TEST(SurfaceAssociation, RejectsUndirectedEdgePoints) {
  FeatureCloud cube;
  for (const float x : {0.9F, 1.0F, 1.1F}) {
    for (const float y : {-0.1F, 0.0F, 0.1F}) {
      for (const float z : {1.9F, 2.0F, 2.1F}) cube.edges.push_back({{x, y, z}, 0.01F});
    }
  }
  const LocalMaps maps = map_of(cube, Association::kSurface);
  EXPECT_TRUE(associate(one_edge({1.0F, 0.0F, 2.0F}), maps, kOrigin, Association::kSurface, kGate)
                  .edges.empty());
}

}  // namespace
}  // namespace mms
