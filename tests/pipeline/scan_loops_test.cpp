// Loop closure with simulated LiDAR scans: the sensor comes back to places that it has seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "mms/geometry/se3.hpp"
#include "mms/global_map/global_map.hpp"
#include "mms/localization/motion/motion_compensation.hpp"
#include "mms/pipeline/perception.hpp"
#include "mms/segmentation/segmenters/mask_segmenter.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

constexpr int kScans = 24;  // of the path
constexpr int kStride = 5;  // scans of the sensor, about half a meter

SceneConfig hall(int seed) {
  SceneConfig config = scene_config("warehouse_loop");
  const auto names = sensor_names();
  config.sensor =
      static_cast<int>(std::find(names.begin(), names.end(), "lidar16") - names.begin());
  config.hz = 10.0;
  config.width = 64;
  config.seed = seed;
  return config;
}

/// Perceived scans with the true masks, without the motion during a scan.
/// @param first  number of the first one of the sensor
std::vector<GlobalKeyframe> scans_of(int seed, int first) {
  SimulatedScene scene(hall(seed));
  Perception perception({}, std::make_unique<MaskSegmenter>());
  std::vector<GlobalKeyframe> scans;
  for (int i = 0; i < kScans; ++i) {
    const int index = first + kStride * i;
    const Frame frame = scene.render(index).frame;
    PerceivedFrame perceived = perception.perceive(frame, perception.segment(frame));
    const Eigen::Isometry3d motion =
        (scene.truth(index).T_world_sensor.inverse() * scene.truth(index + 1).T_world_sensor)
            .isometry();
    deskew(perceived.cloud, 10.0 * se3::log(motion));
    scans.push_back({{}, perceived.cloud, scene.truth(index).T_world_sensor, false});
  }
  return scans;
}

const std::vector<GlobalKeyframe>& first_visit() {
  static const std::vector<GlobalKeyframe> kScansOfIt = scans_of(1, 0);
  return kScansOfIt;
}

/// Other scans of the same path.
const std::vector<GlobalKeyframe>& second_visit() {
  static const std::vector<GlobalKeyframe> kScansOfIt = scans_of(1, 2);
  return kScansOfIt;
}

struct Visits {
  GlobalMap map = [] {
    const SystemConfig system;
    return GlobalMap(system.global_map, system.features, system.odometry.registration);
  }();
  std::vector<Eigen::Isometry3d> truth;  // by keyframe

  /// @param drift  by which the odometry is wrong
  void add(GlobalKeyframe keyframe, const Eigen::Isometry3d& drift) {
    truth.push_back(keyframe.T_world_sensor.isometry());
    keyframe.T_world_sensor = Transform<World, Sensor>(drift * truth.back());
    keyframe.cloud.stamp = Timestamp(static_cast<std::int64_t>(truth.size()) * 1'000'000'000);
    map.add(keyframe);
  }

  int accepted() const {
    return static_cast<int>(
        std::count_if(map.loops().begin(), map.loops().end(),
                      [](const Loop& l) { return l.outcome == LoopOutcome::kAccepted; }));
  }

  void expect_right_loops() const {
    for (const Loop& loop : map.loops()) {
      if (loop.outcome != LoopOutcome::kAccepted) continue;
      const Eigen::Isometry3d error =
          (truth[loop.candidate].inverse() * truth[loop.query]).inverse() * loop.T_candidate_query;
      EXPECT_LT(error.translation().norm(), 0.08);
      EXPECT_LT(se3::angle(error), 0.01);
    }
  }

  double largest_error() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double error = (map.poses()[i].translation() - truth[i].translation()).norm();
      largest = std::max(largest, error);
    }
    return largest;
  }
};

/// Both visits; before the second one, the sensor was carried in the dark.
Visits carried_back(const std::vector<GlobalKeyframe>& second) {
  Visits visits;
  for (const GlobalKeyframe& scan : first_visit()) visits.add(scan, Eigen::Isometry3d::Identity());
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation() = Eigen::Vector3d(2.0, -1.0, 0.3);
  offset.rotate(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  bool after_lost = true;
  for (GlobalKeyframe scan : second) {
    scan.after_lost = std::exchange(after_lost, false);
    visits.add(scan, offset);
  }
  visits.map.finish();
  return visits;
}

TEST(ScanLoops, CorrectTheDriftOfASecondVisit) {
  Visits visits;
  for (const GlobalKeyframe& scan : first_visit()) visits.add(scan, Eigen::Isometry3d::Identity());
  Eigen::Isometry3d drift = Eigen::Isometry3d::Identity();
  drift.translation() = Eigen::Vector3d(0.06, 0.05, 0.0);
  for (const GlobalKeyframe& scan : second_visit()) visits.add(scan, drift);
  visits.map.finish();
  EXPECT_GE(visits.accepted(), kScans / 3);
  visits.expect_right_loops();
}

TEST(ScanLoops, AreFoundWhereTheOdometryKnowsNothing) {
  const Visits visits = carried_back(second_visit());
  EXPECT_GE(visits.accepted(), 2);
  visits.expect_right_loops();
  EXPECT_LT(visits.largest_error(), 0.1);
}

TEST(ScanLoops, AnotherHallOfTheSameKindClosesNone) {
  EXPECT_EQ(carried_back(scans_of(2, 0)).accepted(), 0);
}

TEST(ScanLoops, EqualKeyframesGiveEqualPoses) {
  const Visits a = carried_back(second_visit());
  const Visits b = carried_back(second_visit());
  for (std::size_t i = 0; i < a.map.poses().size(); ++i) {
    EXPECT_EQ(a.map.poses()[i].matrix(), b.map.poses()[i].matrix());
  }
}

GlobalMap with_first_visit() {
  Visits visits;
  for (const GlobalKeyframe& scan : first_visit()) visits.add(scan, Eigen::Isometry3d::Identity());
  return std::move(visits.map);
}

/// A later run of a sensor that stands, with the map of the first visit.
GlobalMap after_standing(GlobalKeyframe scan) {
  const GlobalMap earlier = with_first_visit();
  const SystemConfig system;
  GlobalMap map(system.global_map, system.features, system.odometry.registration);
  map.restore({earlier.records(), earlier.poses(), earlier.loops()}, MapUse::kLocalizeOnly);
  scan.T_world_sensor = {};
  for (int i = 1; i <= 3; ++i) {
    scan.cloud.stamp = Timestamp(i * std::int64_t{200'000'000});
    map.add(scan);
  }
  return map;
}

TEST(ScanLoops, ASensorThatStandsIsRecognizedInAnEarlierMap) {
  const GlobalMap map = after_standing(second_visit()[12]);
  ASSERT_TRUE(map.is_joined(1));
  const Eigen::Vector3d truth = second_visit()[12].T_world_sensor.translation();
  EXPECT_LT((map.poses().back().translation() - truth).norm(), 0.05);
}

TEST(ScanLoops, ASensorThatStandsInAnotherHallIsNotRecognized) {
  EXPECT_FALSE(after_standing(scans_of(2, 0)[12]).is_joined(1));
}

TEST(ScanLoops, ALostScanIsRelocalized) {
  GlobalMap map = with_first_visit();
  GlobalKeyframe lost = second_visit()[12];
  const Eigen::Vector3d truth = lost.T_world_sensor.translation();
  lost.T_world_sensor = {};
  lost.cloud.stamp = Timestamp(100'000'000'000);
  EXPECT_FALSE(map.relocalize(lost));
  lost.cloud.stamp = Timestamp(100'100'000'000);
  const auto place = map.relocalize(lost);
  ASSERT_TRUE(place);
  EXPECT_LT((place->T_world_sensor.translation() - truth).norm(), 0.05);
}

}  // namespace
}  // namespace mms
