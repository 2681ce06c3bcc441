// Pairs and relative poses of keypoints, and agreement of the depth of two views.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <vector>

#include "mms/core/random_stream.hpp"
#include "mms/geometry/camera.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/global_map/corrected_occupancy.hpp"
#include "mms/global_map/keyframes/keyframe_view.hpp"
#include "mms/global_map/keyframes/view_texture.hpp"
#include "mms/global_map/loops/keypoint_matching.hpp"
#include "mms/global_map/loops/lost_verification.hpp"
#include "mms/global_map/loops/place_matching.hpp"
#include "mms/global_map/loops/point_alignment.hpp"

namespace mms {
namespace {

Eigen::Isometry3d some_pose() {
  Vector6d tangent;
  tangent << 0.4, -0.2, 0.7, 0.1, 0.5, -0.2;
  return se3::exp(tangent);
}

/// Pairs of which a share agrees with `some_pose`, with noise of 1 cm.
PointPairs sample_pairs(int count, double share, std::uint64_t seed) {
  RandomStream random(seed);
  PointPairs pairs;
  const auto point = [&](float size) {
    return Eigen::Vector3f(random.between(-size, size), random.between(-size, size),
                           random.between(-size, size))
        .cast<double>()
        .eval();
  };
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d b = point(3.0F);
    const bool agrees = i < share * count;
    pairs.a.push_back(agrees ? Eigen::Vector3d(some_pose() * b + point(0.01F)) : point(3.0F));
    pairs.b.push_back(b);
    pairs.sigma.push_back(0.01);
  }
  return pairs;
}

TEST(PointAlignment, FindsThePoseAmongWrongPairs) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const auto alignment = align_points(sample_pairs(100, 0.3, seed), seed);
    ASSERT_TRUE(alignment);
    EXPECT_GE(alignment->inliers.size(), 28U);
    const Eigen::Isometry3d error = some_pose().inverse() * alignment->T_a_b;
    EXPECT_LT(error.translation().norm(), 0.01);
    EXPECT_LT(se3::angle(error), 0.01);
  }
}

/// As of a view that people cover: few of the similar keypoints are right.
TEST(PointAlignment, FindsThePoseAmongATenthOfRightPairs) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto alignment = align_points(sample_pairs(100, 0.1, seed), seed);
    found += alignment && alignment->inliers.size() >= 8U ? 1 : 0;
  }
  EXPECT_GE(found, 18);
}

TEST(PointAlignment, EqualArgumentsGiveEqualPoses) {
  const PointPairs pairs = sample_pairs(60, 0.5, 8);
  EXPECT_EQ(align_points(pairs, 1)->T_a_b.matrix(), align_points(pairs, 1)->T_a_b.matrix());
}

TEST(PointAlignment, RandomPairsHaveFewInliers) {
  const auto alignment = align_points(sample_pairs(100, 0.0, 3), 3);
  EXPECT_TRUE(!alignment || alignment->inliers.size() < 10U);
}

TEST(PointAlignment, TooFewPairsGiveNone) {
  EXPECT_FALSE(align_points({}, 1));
  EXPECT_FALSE(align_points(sample_pairs(3, 1.0, 1), 1));
}

TEST(KeypointMatching, FindsEachOthersNearestAlone) {
  RandomStream random(4);
  std::vector<BinaryDescriptor> a(50);
  for (BinaryDescriptor& descriptor : a) {
    for (std::uint64_t& word : descriptor.words) word = random.bits();
  }
  std::vector<BinaryDescriptor> b(a.rbegin(), a.rend());
  for (BinaryDescriptor& descriptor : b) descriptor.words[1] ^= 0xFFU;
  b.push_back(b.front());  // ambiguous: a.back() has two equally near ones
  const std::vector<KeypointMatch> matches = match_keypoints(a, b);
  ASSERT_EQ(matches.size(), 49U);
  for (const KeypointMatch& match : matches) EXPECT_EQ(match.b, 49U - match.a);
  EXPECT_TRUE(match_keypoints(a, {}).empty());
}

/// Keypoints with depth, all with other descriptors.
ImageKeypoints some_keypoints(std::size_t count, std::uint64_t seed) {
  RandomStream random(seed);
  ImageKeypoints keypoints;
  for (std::size_t i = 0; i < count; ++i) {
    BinaryDescriptor descriptor;
    for (std::uint64_t& word : descriptor.words) word = random.bits();
    keypoints.descriptors.push_back(descriptor);
    keypoints.points.emplace_back(random.between(-2.0F, 2.0F), random.between(-1.0F, 1.0F),
                                  random.between(1.0F, 5.0F));
    keypoints.pixels.emplace_back(0.5F, 0.5F);
  }
  return keypoints;
}

TEST(PlaceMatching, FindsSimilarKeypointsAtTheirPlacesAlone) {
  std::deque<KeyframeRecord> records(2);
  records[0].keypoints = some_keypoints(100, 1);
  records[1].keypoints = some_keypoints(100, 2);
  const std::vector<Eigen::Isometry3d> poses = {Eigen::Isometry3d::Identity(), some_pose()};
  const PlacedKeypoints place = keypoints_at(records, poses, 0, 2, DepthNoise{});
  ASSERT_EQ(place.points.size(), 200U);
  // The frame has half of each keyframe's keypoints, with a tenth of the bits flipped.
  const Eigen::Isometry3d pose = se3::exp(0.1 * Vector6d::Ones());
  ImageKeypoints frame;
  for (std::size_t i = 0; i < 200; i += 2) {
    BinaryDescriptor descriptor = place.descriptors[i];
    descriptor.words[i % 4] ^= 0x3FFFFFFU;
    frame.descriptors.push_back(descriptor);
    frame.points.emplace_back((pose.inverse() * place.points[i]).cast<float>());
  }
  frame.points[7].x() += 1.0F;                       // elsewhere
  frame.descriptors[9].words[0] ^= 0x3FFFFFFU << 1;  // of something else
  frame.descriptors[9].words[1] ^= 0x3FFFFFFU;
  // A twin, less similar.
  frame.descriptors.push_back(frame.descriptors[20]);
  frame.descriptors.back().words[3] ^= 0xFU << 30;
  frame.points.push_back(frame.points[20]);
  const PlaceMatches matches = match_at_place(place, frame, pose, DepthNoise{});
  EXPECT_EQ(matches.frames.size(), 98U);
  for (std::size_t i = 0; i < matches.frames.size(); ++i) {
    EXPECT_NE(matches.frames[i], 7U);
    EXPECT_NE(matches.frames[i], 9U);
    EXPECT_LT(matches.frames[i], 100U);
    EXPECT_TRUE(matches.pairs.a[i].isApprox(place.points[2 * matches.frames[i]]));
  }
  const PointAlignment alignment =
      refine_alignment(matches.pairs, se3::exp(0.003 * Vector6d::Ones()) * pose);
  EXPECT_TRUE(alignment.T_a_b.isApprox(pose, 1e-5));
  EXPECT_TRUE(match_at_place(place, {}, pose, DepthNoise{}).frames.empty());
  EXPECT_TRUE(match_at_place({}, frame, pose, DepthNoise{}).frames.empty());
}

/// Most of what the frame shows is in the keyframes around the candidate.
TEST(LostFrame, EightPairsWithTheCandidateAreEnoughForAFirstPose) {
  std::deque<KeyframeRecord> records(7);
  for (std::size_t k = 0; k < records.size(); ++k) {
    records[k].keypoints = some_keypoints(60, k + 1);
  }
  const std::vector<Eigen::Isometry3d> poses(records.size(), Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d pose = se3::exp(0.1 * Vector6d::Ones());
  KeyframeRecord frame;
  for (const KeyframeRecord& record : records) {
    for (std::size_t i = 0; i < 12; ++i) {
      const Eigen::Vector3d point = record.keypoints.points[i].cast<double>();
      frame.keypoints.descriptors.push_back(record.keypoints.descriptors[i]);
      frame.keypoints.points.emplace_back((pose.inverse() * point).cast<float>());
      frame.keypoints.pixels.emplace_back(0.5F, 0.5F);
    }
  }
  const LostFrameVerifier verifier(LoopConfig{}, RegistrationConfig{}, DepthNoise{});
  const Loop loop = verifier.verify(records, poses, 3, frame);
  EXPECT_GE(loop.inliers, 80);
  EXPECT_EQ(loop.outcome, LoopOutcome::kNotSpread);  // all are at one pixel
}

constexpr CameraIntrinsics kCamera{300.0, 300.0, 159.5, 119.5, 320, 240, {}};

/// A wall at a distance, with a box of 1 m in front of it unless it is left out.
LabeledCloud room(const Eigen::Isometry3d& T_world_camera, bool with_box) {
  LabeledCloud cloud;
  cloud.camera = kCamera;
  cloud.width = kCamera.width;
  cloud.height = kCamera.height;
  const Eigen::Isometry3d T = T_world_camera;
  const std::vector<Eigen::Vector3f> rays = CameraModel(kCamera).ray_table();
  for (const Eigen::Vector3f& ray : rays) {
    const Eigen::Vector3d direction = T.linear() * ray.cast<double>();
    double depth = (4.0 - T.translation().z()) / direction.z();
    const double to_box = (2.0 - T.translation().z()) / direction.z();
    const Eigen::Vector3d at = T.translation() + to_box * direction;
    if (with_box && std::abs(at.x()) < 0.5 && std::abs(at.y()) < 0.5) depth = to_box;
    cloud.points.push_back(ray * static_cast<float>(depth));
    cloud.labels.push_back(PointLabel::kStatic);
  }
  return cloud;
}

Eigen::Isometry3d moved(double x, double z) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, 0.0, z);
  return T;
}

TEST(KeyframeView, ViewsOfOneSceneAgree) {
  const KeyframeView a = make_keyframe_view({}, room(moved(0.0, 0.0), true));
  const KeyframeView b = make_keyframe_view({}, room(moved(0.3, 0.2), true));
  EXPECT_EQ(a.depth_mm.width(), 80);
  const ViewAgreement agreement = compare_views(a, b, moved(0.3, 0.2), DepthNoise{});
  EXPECT_GT(agreement.overlap, 0.8);
  EXPECT_LT(agreement.contradiction, 0.01);
}

TEST(KeyframeView, AMissingBoxContradicts) {
  const KeyframeView with = make_keyframe_view({}, room(moved(0.0, 0.0), true));
  const KeyframeView without = make_keyframe_view({}, room(moved(0.3, 0.2), false));
  EXPECT_GT(compare_views(without, with, moved(0.3, 0.2).inverse(), DepthNoise{}).contradiction,
            0.1);
  EXPECT_LT(compare_views(with, without, moved(0.3, 0.2), DepthNoise{}).overlap, 0.8);
}

TEST(KeyframeView, AWrongPoseContradicts) {
  const KeyframeView a = make_keyframe_view({}, room(moved(0.0, 0.0), true));
  EXPECT_GT(compare_views(a, a, moved(0.0, -0.4), DepthNoise{}).contradiction, 0.5);
}

TEST(KeyframeView, DynamicPointsAreNotCompared) {
  LabeledCloud cloud = room(moved(0.0, 0.0), true);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.points[i].z() < 3.0F) cloud.labels[i] = PointLabel::kDynamic;
  }
  const KeyframeView with = make_keyframe_view({}, cloud);
  const KeyframeView without = make_keyframe_view({}, room(moved(0.0, 0.0), false));
  EXPECT_LT(compare_views(without, with, moved(0.0, 0.0), DepthNoise{}).contradiction, 0.01);
}

/// The room with people 1 m before the camera, in a part of the columns.
KeyframeView covered_room(double share) {
  LabeledCloud cloud = room(moved(0.0, 0.0), true);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (static_cast<int>(i) % cloud.width > share * cloud.width) continue;
    cloud.points[i] *= 1.0F / cloud.points[i].z();
    cloud.labels[i] = PointLabel::kDynamic;
  }
  return make_keyframe_view({}, cloud);
}

TEST(KeyframeView, PointsBehindPeopleDoNotCountAsMissing) {
  const KeyframeView open = make_keyframe_view({}, room(moved(0.0, 0.0), true));
  const auto overlap = [&](const KeyframeView& a, const KeyframeView& b) {
    return compare_views(a, b, moved(0.0, 0.0), DepthNoise{}).overlap;
  };
  EXPECT_GT(overlap(covered_room(0.5), open), 0.9);
  EXPECT_GT(overlap(open, covered_room(0.5)), 0.9);
  // What is left of this view identifies no place.
  EXPECT_LT(overlap(covered_room(0.96), open), 0.2);
}

/// An image of the room, whose surfaces have a pattern of their own or another one.
Image<Rgb> image_of(const LabeledCloud& room, const Eigen::Isometry3d& T_world_camera,
                    double phase) {
  Image<Rgb> image(room.width, room.height);
  for (std::size_t i = 0; i < image.size(); ++i) {
    const Eigen::Vector3d at = T_world_camera * room.points[i].cast<double>();
    const double wave = std::sin(11.0 * at.x() + phase * at.y()) + std::sin(13.0 * at.y() - phase);
    const auto gray = static_cast<std::uint8_t>(120.0 + 6.0 * wave);
    image[i] = {gray, gray, gray};
  }
  return image;
}

/// A view of the room with a pattern.
KeyframeView textured_view(const Eigen::Isometry3d& T_world_camera, double phase) {
  const LabeledCloud cloud = room(T_world_camera, true);
  return make_keyframe_view(image_of(cloud, T_world_camera, phase), cloud);
}

TEST(ViewTexture, EqualSurfacesWithOtherTextureDiffer) {
  const Eigen::Isometry3d pose = moved(0.3, 0.2);
  const auto compared = [&](double phase) {
    return compare_textures(textured_view(moved(0.0, 0.0), 1.0), textured_view(pose, phase), pose,
                            DepthNoise{});
  };
  EXPECT_GT(compared(1.0).patches, 300U);
  EXPECT_LT(compared(1.0).dissimilarity(), 0.02);
  EXPECT_GT(compared(4.0).dissimilarity(), 0.3);
}

TEST(ViewTexture, AWrongPoseDiffers) {
  const KeyframeView view = textured_view(moved(0.0, 0.0), 1.0);
  EXPECT_EQ(compare_textures(view, view, moved(0.0, 0.0), DepthNoise{}).different, 0U);
  EXPECT_GT(compare_textures(view, view, moved(0.25, 0.0), DepthNoise{}).dissimilarity(), 0.3);
}

TEST(ViewTexture, ViewsWithoutImageOrTextureDoNotDiffer) {
  const Eigen::Isometry3d pose = moved(0.0, 0.0);
  const KeyframeView textured = textured_view(pose, 1.0);
  const KeyframeView without = make_keyframe_view({}, room(pose, true));
  EXPECT_EQ(compare_textures(textured, without, pose, DepthNoise{}).patches, 0U);
  EXPECT_EQ(compare_textures(without, textured, pose, DepthNoise{}).dissimilarity(), 0.0);
  const LabeledCloud cloud = room(pose, true);
  const Image<Rgb> plain(cloud.width, cloud.height);
  EXPECT_EQ(
      compare_textures(make_keyframe_view(plain, cloud), textured, pose, DepthNoise{}).patches, 0U);
}

TEST(CorrectedOccupancy, HasTheViewsOfJoinedSessionsAtTheirCorrectedPoses) {
  std::deque<KeyframeRecord> records(3);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].session = i < 2 ? 0 : 1;
    records[i].features.planes.resize(1);
    records[i].view = make_keyframe_view({}, room(moved(0.3, 0.2), true));
    records[i].T_world_sensor = Transform<World, Sensor>(moved(9.0, 9.0));  // drifted
  }
  const std::vector<Eigen::Isometry3d> poses = {moved(0.3, 0.2), moved(0.3, 0.2), moved(50.0, 0.0)};
  const OccupancyMap map = corrected_occupancy(
      records, poses, [](std::uint32_t session) { return session == 0; }, {}, {});
  EXPECT_EQ(map.at(Eigen::Vector3d(0.0, 0.0, 2.02)), Occupancy::kOccupied);  // box
  EXPECT_EQ(map.at(Eigen::Vector3d(1.0, 0.0, 4.02)), Occupancy::kOccupied);  // wall
  EXPECT_EQ(map.at(Eigen::Vector3d(0.2, 0.1, 1.0)), Occupancy::kFree);
  EXPECT_EQ(map.at(Eigen::Vector3d(0.0, 0.0, 3.0)), Occupancy::kUnknown);  // behind the box
  EXPECT_EQ(map.at(Eigen::Vector3d(50.0, 0.0, 1.0)), Occupancy::kUnknown);
}

}  // namespace
}  // namespace mms
