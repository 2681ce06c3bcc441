// LiDAR keyframes: density images, their keypoints, alignment on the floor, agreement of scans.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mms/core/random_stream.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/global_map/keyframes/density_image.hpp"
#include "mms/global_map/keyframes/local_scans.hpp"
#include "mms/global_map/keyframes/scan_keypoints.hpp"
#include "mms/global_map/keyframes/scan_signature.hpp"
#include "mms/global_map/keyframes/scan_view.hpp"
#include "mms/global_map/loops/floor_alignment.hpp"
#include "mms/global_map/loops/keypoint_matching.hpp"

namespace mms {
namespace {

using Points = std::vector<Eigen::Vector3f>;

TEST(DensityImage, CountsTheVoxelsOverAPlace) {
  Points points;
  for (int i = 0; i < 10; ++i) {
    const float z = 0.25F + 0.1F * static_cast<float>(i);
    points.emplace_back(1.05F, 2.05F, z);
    points.emplace_back(1.06F, 2.04F, z);  // in the same voxel
  }
  points.emplace_back(0.05F, 0.05F, 0.1F);   // floor
  points.emplace_back(0.05F, 0.05F, 6.0F);   // roof
  points.emplace_back(3.05F, 2.05F, 1.05F);  // one voxel
  const DensityImage image = make_density_image(points);
  int filled = 0;
  for (int y = 0; y < image.share.height(); ++y) {
    for (int x = 0; x < image.share.width(); ++x) {
      if (image.share(x, y) == 0) continue;
      ++filled;
      const Eigen::Vector2d place = image.place_of({x, y});
      EXPECT_NEAR(place.y(), 2.05, 1e-5);
      EXPECT_NEAR(place.x(), image.share(x, y) == 170 ? 1.05 : 3.05, 1e-5);
      EXPECT_EQ(image.share(x, y), place.x() < 2.0 ? 170 : 17);
    }
  }
  EXPECT_EQ(filled, 2);
  EXPECT_TRUE(make_density_image({}).share.empty());
}

TEST(DensityImage, FarPointsDoNotExceedItsLargestSize) {
  const Points points = {{0.0F, 0.0F, 1.0F}, {1e5F, -1e5F, 1.0F}};
  const DensityImage image = make_density_image(points);
  EXPECT_LE(image.share.width(), 1100);
  EXPECT_LE(image.share.height(), 1100);
}

Eigen::Isometry2d floor_pose() {
  Eigen::Isometry2d T = Eigen::Isometry2d::Identity();
  T.rotate(2.5);
  T.translation() = Eigen::Vector2d(4.0, -7.0);
  return T;
}

struct Places {
  std::vector<Eigen::Vector2d> a;
  std::vector<Eigen::Vector2d> b;
};

/// Pairs of which a share agrees with `floor_pose`, with noise of 5 cm.
Places sample_places(int count, double share, std::uint64_t seed) {
  RandomStream random(seed);
  const auto place = [&](float size) {
    const float x = random.between(-size, size);
    return Eigen::Vector2f(x, random.between(-size, size)).cast<double>().eval();
  };
  Places places;
  for (int i = 0; i < count; ++i) {
    places.b.push_back(place(20.0F));
    places.a.push_back(i < share * count ? floor_pose() * places.b.back() + place(0.05F)
                                         : place(20.0F));
  }
  return places;
}

TEST(FloorAlignment, FindsTheTransformAmongWrongPairs) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const Places places = sample_places(100, 0.2, seed);
    const auto alignment = align_on_floor(places.a, places.b, 0.3, seed);
    ASSERT_TRUE(alignment);
    EXPECT_GE(alignment->inliers.size(), 20U);
    const Eigen::Isometry2d error = floor_pose().inverse() * alignment->T_a_b;
    EXPECT_LT(error.translation().norm(), 0.05);
    EXPECT_LT(std::abs(Eigen::Rotation2Dd(error.linear()).angle()), 0.005);
  }
}

TEST(FloorAlignment, RandomPairsHaveFewInliers) {
  const Places places = sample_places(100, 0.0, 3);
  const auto alignment = align_on_floor(places.a, places.b, 0.3, 3);
  EXPECT_TRUE(!alignment || alignment->inliers.size() < 7U);
  EXPECT_FALSE(align_on_floor({}, {}, 0.3, 1));
}

TEST(FloorAlignment, EqualArgumentsGiveEqualTransforms) {
  const Places places = sample_places(60, 0.5, 8);
  EXPECT_EQ(align_on_floor(places.a, places.b, 0.3, 1)->T_a_b.matrix(),
            align_on_floor(places.a, places.b, 0.3, 1)->T_a_b.matrix());
}

void add_wall(Points& points, const Eigen::Vector2f& from, const Eigen::Vector2f& to,
              float height) {
  const int steps = static_cast<int>((to - from).norm() / 0.04F) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2f at =
        from + (static_cast<float>(i) / static_cast<float>(steps)) * (to - from);
    for (float z = 0.02F; z < height; z += 0.05F) points.emplace_back(at.x(), at.y(), z);
  }
}

/// Walls of different lengths, directions and heights, others for another seed, on a floor of 30 m
/// at z = 0.
Points hall(std::uint64_t seed) {
  RandomStream random(seed);
  Points points;
  for (int i = 0; i < 150; ++i) {
    const float x = random.between(-15.0F, 15.0F);
    const Eigen::Vector2f from(x, random.between(-15.0F, 15.0F));
    const float dx = random.between(-2.0F, 2.0F);
    const Eigen::Vector2f to = from + Eigen::Vector2f(dx, random.between(-2.0F, 2.0F));
    add_wall(points, from, to, random.between(0.4F, 2.0F));
  }
  for (float x = -15.0F; x < 15.0F; x += 0.1F) {
    for (float y = -15.0F; y < 15.0F; y += 0.1F) points.emplace_back(x, y, 0.0F);
  }
  return points;
}

/// A sensor 1 m over the floor, tilted by 5 degrees.
Eigen::Isometry3d sensor_at(double x, double y, double heading) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, y, 1.0);
  T.rotate(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
  T.rotate(Eigen::AngleAxisd(0.087, Eigen::Vector3d::UnitX()));
  return T;
}

struct Described {
  Eigen::Isometry3d T_sensor_floor;
  ImageKeypoints keypoints;
};

Described describe(Points points, const Eigen::Isometry3d& T_world_sensor) {
  const Eigen::Isometry3f T = T_world_sensor.inverse().cast<float>();
  for (Eigen::Vector3f& point : points) point = T * point;
  const Eigen::Isometry3d T_sensor_floor = floor_frame(points, Eigen::Vector3d::UnitZ());
  return {T_sensor_floor, extract_scan_keypoints(std::move(points), T_sensor_floor)};
}

TEST(ScanKeypoints, FloorOfATiltedSensorIsFound) {
  const Eigen::Isometry3d T_world_sensor = sensor_at(1.0, 2.0, 0.7);
  const Eigen::Isometry3d T_world_floor =
      T_world_sensor * describe(hall(1), T_world_sensor).T_sensor_floor;
  EXPECT_NEAR(T_world_floor.translation().z(), 0.0, 0.02);
  EXPECT_GT(T_world_floor.linear()(2, 2), std::cos(0.01));
}

TEST(ScanKeypoints, TwoViewsOfAHallGiveTheirRelativePose) {
  const Eigen::Isometry3d T_a = sensor_at(0.0, 0.0, 0.0);
  const Eigen::Isometry3d T_b = sensor_at(3.2, -1.7, 2.2);
  const Described a = describe(hall(1), T_a);
  const Described b = describe(hall(1), T_b);
  const auto matches = match_keypoints(a.keypoints.descriptors, b.keypoints.descriptors);
  Places places;
  for (const KeypointMatch& match : matches) {
    places.a.push_back(a.keypoints.pixels[match.a].cast<double>());
    places.b.push_back(b.keypoints.pixels[match.b].cast<double>());
  }
  const auto alignment = align_on_floor(places.a, places.b, 0.3, 1);
  ASSERT_TRUE(alignment);
  EXPECT_GE(alignment->inliers.size(), 10U);  // as a loop needs
  const Eigen::Isometry3d truth =
      (T_a * a.T_sensor_floor).inverse() * T_b * b.T_sensor_floor;  // of the floor frames
  EXPECT_LT((truth.translation().head<2>() - alignment->T_a_b.translation()).norm(), 0.1);
  EXPECT_LT((truth.linear().topLeftCorner<2, 2>() - alignment->T_a_b.linear()).norm(), 0.02);
}

TEST(ScanKeypoints, AnotherHallHasFewAlike) {
  const Described a = describe(hall(1), sensor_at(0.0, 0.0, 0.0));
  const Described b = describe(hall(2), sensor_at(0.0, 0.0, 0.0));
  const auto matches = match_keypoints(a.keypoints.descriptors, b.keypoints.descriptors);
  Places places;
  for (const KeypointMatch& match : matches) {
    places.a.push_back(a.keypoints.pixels[match.a].cast<double>());
    places.b.push_back(b.keypoints.pixels[match.b].cast<double>());
  }
  const auto alignment = align_on_floor(places.a, places.b, 0.3, 1);
  EXPECT_TRUE(!alignment || alignment->inliers.size() < 10U);
}

TEST(ScanKeypoints, EqualPostsIdentifyNoPlace) {
  Points points;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 10; ++column) {
      const Eigen::Vector2f at(2.5F * static_cast<float>(column), 4.0F * static_cast<float>(row));
      add_wall(points, at, at + Eigen::Vector2f(0.8F, 0.0F), 2.0F);
      add_wall(points, at, at + Eigen::Vector2f(0.0F, 0.8F), 2.0F);
    }
  }
  const ImageKeypoints keypoints = extract_scan_keypoints(points, Eigen::Isometry3d::Identity());
  EXPECT_LT(keypoints.size(), 20U);  // at the border of the grid
}

TEST(LocalScans, ForgetsWhatIsFarBehind) {
  LabeledCloud cloud;
  cloud.points = {{5.0F, 0.0F, 0.0F}, {6.0F, 0.0F, 0.0F}, {100.0F, 0.0F, 0.0F}};
  cloud.labels = {PointLabel::kStatic, PointLabel::kDynamic, PointLabel::kStatic};
  LocalScans scans;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (int i = 0; i <= 20; ++i) {
    pose.translation().x() = i;
    scans.add(cloud, Transform<World, Sensor>(pose));
  }
  const Points points = scans.points();
  ASSERT_EQ(points.size(), 11U);  // one of each scan of the last 10 m
  EXPECT_NEAR(points.front().x(), -5.0F, 1e-5F);
  EXPECT_NEAR(points.back().x(), 5.0F, 1e-5F);
}

/// A square room of 10 m with a box in it unless that is left out, in all directions.
LabeledCloud room(const Eigen::Isometry3d& T_world_sensor, bool with_box) {
  LabeledCloud cloud;
  cloud.height = 1;
  for (int ring = -8; ring <= 8; ++ring) {
    for (int i = 0; i < 720; ++i) {
      const double azimuth = 2.0 * M_PI * i / 720.0;
      const double elevation = 0.035 * ring;
      const Eigen::Vector3d ray(std::cos(azimuth), std::sin(azimuth), std::tan(elevation));
      const Eigen::Vector3d direction = T_world_sensor.linear() * ray;
      const Eigen::Vector3d& from = T_world_sensor.translation();
      double length = 1e9;
      for (int axis = 0; axis < 2; ++axis) {
        const double wall = direction(axis) > 0.0 ? 5.0 : -5.0;
        if (direction(axis) != 0.0) {
          length = std::min(length, (wall - from(axis)) / direction(axis));
        }
      }
      const double to_box = (2.0 - from.x()) / direction.x();
      if (with_box && to_box > 0.0 && std::abs(from.y() + to_box * direction.y()) < 1.0) {
        length = std::min(length, to_box);
      }
      cloud.points.push_back((length * ray).cast<float>());
      cloud.labels.push_back(PointLabel::kStatic);
    }
  }
  cloud.width = static_cast<int>(cloud.points.size());
  return cloud;
}

Eigen::Isometry3d moved_by(double x, double turn) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().x() = x;
  T.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  return T;
}

TEST(ScanView, ScansOfOneRoomAgree) {
  const Eigen::Isometry3d T = moved_by(0.4, 1.0);
  const ScanView a = make_scan_view(room(Eigen::Isometry3d::Identity(), true));
  const ScanView b = make_scan_view(room(T, true));
  EXPECT_LT(a.points.size(), 2U * 17U * 420U);
  const ViewAgreement agreement = compare_scans(a, b, T);
  EXPECT_GT(agreement.overlap, 0.9);
  EXPECT_LT(agreement.contradiction, 0.005);
}

TEST(ScanView, AMissingBoxAndAWrongPoseContradict) {
  const Eigen::Isometry3d T = moved_by(0.4, 1.0);
  const ScanView with = make_scan_view(room(Eigen::Isometry3d::Identity(), true));
  const ScanView without = make_scan_view(room(T, false));
  EXPECT_GT(compare_scans(without, with, T.inverse()).contradiction, 0.05);
  EXPECT_GT(compare_scans(with, with, moved_by(1.0, 0.0)).contradiction, 0.05);
}

TEST(ScanView, DynamicPointsAreNotCompared) {
  LabeledCloud cloud = room(Eigen::Isometry3d::Identity(), true);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Eigen::Vector3f& point = cloud.points[i];
    if (std::abs(point.x() - 2.0F) < 1e-3F && std::abs(point.y()) < 1.0F) {
      cloud.labels[i] = PointLabel::kDynamic;
    }
  }
  const ScanView without = make_scan_view(room(Eigen::Isometry3d::Identity(), false));
  EXPECT_LT(
      compare_scans(without, make_scan_view(cloud), Eigen::Isometry3d::Identity()).contradiction,
      0.005);
}

TEST(LocalScans, AreBoundedWhereTheSensorTurnsOnTheSpot) {
  LabeledCloud cloud;
  cloud.points = {{5.0F, 0.0F, 0.0F}};
  cloud.labels = {PointLabel::kStatic};
  LocalScans scans;
  for (int i = 0; i < 500; ++i) {
    scans.add(cloud, Transform<World, Sensor>(moved_by(0.0, 0.26 * i)));
  }
  EXPECT_LE(scans.points().size(), 40U);
}

/// A view of the room; its floor is 1.5 m below.
ScanView view_of(const Eigen::Isometry3d& T_world_sensor, bool with_box) {
  ScanView view = make_scan_view(room(T_world_sensor, with_box));
  view.T_sensor_floor.translation().z() = -1.5;
  return view;
}

TEST(ScanPlaces, FindTheKeyframeAndItsTurn) {
  ScanPlaces places;
  for (int i = 0; i < 20; ++i) places.add(view_of(moved_by(-4.0 + 0.4 * i, 0.0), true));
  const auto all = [](std::size_t) { return true; };
  const auto found = places.find(view_of(moved_by(-4.0 + 0.4 * 5, 1.2), true), all, 3);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(static_cast<double>(found[0].keyframe), 5.0, 1.0);
  EXPECT_NEAR(found[0].turn, 1.2, 0.06);
  EXPECT_TRUE(places
                  .find(
                      view_of(moved_by(0.0, 0.0), true), [](std::size_t) { return false; }, 3)
                  .empty());
  EXPECT_TRUE(places.find({}, all, 3).empty());
}

}  // namespace
}  // namespace mms
