#include "mms/evaluation/tracking/tracking_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

constexpr int kFrames = 90;
constexpr double kPeriod = 1.0 / 30.0;  // [s]

Timestamp stamp(int frame) {
  return Timestamp(1'000'000'000 + frame * 33'333'333LL);
}

ObjectBox object(int id, const Eigen::Vector3d& center,
                 const Eigen::Vector3d& velocity = {1, 0, 0}) {
  ObjectBox box;
  box.id = id;
  box.T_world_box.translation() = center;
  box.size = {0.5, 0.5, 1.7};
  box.velocity = velocity;
  box.moving = velocity.norm() > 0.05;
  return box;
}

/// A sensor at the origin.
Trajectory static_sensor() {
  Trajectory poses;
  for (int i = 0; i < kFrames; ++i) poses.push_back({stamp(i), {}});
  return poses;
}

/// Two persons who walk side by side, 2 m apart, at about 5 m.
ObjectHistory two_walkers() {
  ObjectHistory history;
  for (int i = 0; i < kFrames; ++i) {
    const double x = -1.5 + kPeriod * i;
    history.push_back({stamp(i), {object(0, {x, 0, 4}), object(1, {x, 0, 6})}});
  }
  return history;
}

TEST(TrackingError, IsZeroForGroundTruth) {
  const TrackingError error = evaluate_tracking(two_walkers(), two_walkers(), static_sensor());
  EXPECT_EQ(error.objects, 2 * kFrames);
  EXPECT_EQ(error.idf1, 1.0);
  EXPECT_EQ(error.recall, 1.0);
  EXPECT_EQ(error.false_discovery_rate, 0.0);
  EXPECT_EQ(error.id_switches, 0);
  EXPECT_EQ(error.center_mean, 0.0);
  EXPECT_EQ(error.velocity_rmse, 0.0);
  EXPECT_EQ(error.motion_state_changes, 0);
  EXPECT_TRUE(std::isnan(error.motion_state_delay_max));
}

TEST(TrackingError, MeasuresCenterAndVelocityError) {
  ObjectHistory tracks = two_walkers();
  for (ObjectFrame& frame : tracks) {
    for (ObjectBox& box : frame.objects) {
      box.T_world_box.translation().z() += box.id == 0 ? 0.1 : 0.3;
      box.velocity.y() += 0.2;
    }
  }
  const TrackingError error = evaluate_tracking(two_walkers(), tracks, static_sensor());
  EXPECT_NEAR(error.center_mean, 0.2, 1e-12);
  EXPECT_NEAR(error.velocity_rmse, 0.2, 1e-12);
}

TEST(TrackingError, IdChangeReducesIdf1) {
  ObjectHistory tracks = two_walkers();
  for (std::size_t i = 0; i < tracks.size(); ++i) tracks[i].objects[0].id = i < 45 ? 7 : 8;
  const TrackingError error = evaluate_tracking(two_walkers(), tracks, static_sensor());
  EXPECT_EQ(error.id_switches, 1);
  // 45 + 90 of 180 boxes on both sides belong to a pair of ids.
  EXPECT_NEAR(error.idf1, 135.0 / 180.0, 1e-12);
  EXPECT_EQ(error.recall, 1.0);
}

TEST(TrackingError, SwappedIdsAreTwoSwitches) {
  ObjectHistory tracks = two_walkers();
  for (std::size_t i = 60; i < tracks.size(); ++i) {
    std::swap(tracks[i].objects[0].id, tracks[i].objects[1].id);
  }
  const TrackingError error = evaluate_tracking(two_walkers(), tracks, static_sensor());
  EXPECT_EQ(error.id_switches, 2);
  EXPECT_NEAR(error.idf1, 60.0 / 90.0, 1e-12);
}

TEST(TrackingError, CountsMissesAndFalseDiscoveries) {
  ObjectHistory tracks = two_walkers();
  for (ObjectFrame& frame : tracks) frame.objects[1] = object(9, {-3, 0, 4});
  const TrackingError error = evaluate_tracking(two_walkers(), tracks, static_sensor());
  EXPECT_NEAR(error.recall, 0.5, 1e-12);
  EXPECT_NEAR(error.false_discovery_rate, 0.5, 1e-12);
  EXPECT_NEAR(error.idf1, 0.5, 1e-12);
}

TEST(TrackingError, ExcludesDistantAndHiddenObjects) {
  ObjectHistory truth = two_walkers();
  for (ObjectFrame& frame : truth) {
    frame.objects[1].visible = 0.1;
    frame.objects.push_back(object(2, {0, 0, 12}));
  }
  const TrackingError error = evaluate_tracking(truth, two_walkers(), static_sensor());
  EXPECT_EQ(error.objects, kFrames);
  EXPECT_EQ(error.recall, 1.0);
  EXPECT_EQ(error.false_discovery_rate, 0.0);  // the track of the hidden object is ignored
}

TEST(TrackingError, TrackOfHiddenObjectMatchesNoOther) {
  ObjectHistory truth = two_walkers();
  ObjectHistory tracks = two_walkers();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    truth[i].objects[1] = object(1, truth[i].objects[0].center() + Eigen::Vector3d(0, 0, 0.9));
    truth[i].objects[1].visible = 0.1;
    tracks[i].objects = {truth[i].objects[1]};
  }
  const TrackingError error = evaluate_tracking(truth, tracks, static_sensor());
  EXPECT_EQ(error.objects, kFrames);
  EXPECT_EQ(error.recall, 0.0);  // although the track is less than a metre away
  EXPECT_EQ(error.idf1, 0.0);
  EXPECT_TRUE(std::isnan(error.false_discovery_rate));
  EXPECT_TRUE(std::isnan(error.center_mean));
}

TEST(TrackingError, MeasuresDelayOfDetectedStop) {
  ObjectHistory truth;
  ObjectHistory tracks;
  for (int i = 0; i < kFrames; ++i) {
    const Eigen::Vector3d velocity(i < 30 ? 1.0 : 0.0, 0, 0);
    const Eigen::Vector3d center(std::min(i, 30) * kPeriod, 0, 5);
    truth.push_back({stamp(i), {object(0, center, velocity)}});
    tracks.push_back({stamp(i), {object(4, center, velocity)}});
    tracks.back().objects[0].moving = i < 45;
  }
  TrackingError error = evaluate_tracking(truth, tracks, static_sensor());
  EXPECT_EQ(error.motion_state_changes, 1);
  EXPECT_NEAR(error.motion_state_delay_max, 15 * kPeriod, 1e-6);

  for (ObjectFrame& frame : tracks) frame.objects[0].moving = true;
  truth.back().objects[0].visible = 0.0;  // visible for nearly two seconds after the stop
  error = evaluate_tracking(truth, tracks, static_sensor());
  EXPECT_EQ(error.motion_state_changes, 1);
  EXPECT_NEAR(error.motion_state_delay_max, 58 * kPeriod, 1e-6);
}

TEST(TrackingError, CountsStopMissedUntilTheEnd) {
  ObjectHistory truth;
  ObjectHistory tracks;
  for (int i = 0; i < kFrames; ++i) {
    truth.push_back({stamp(i), {object(0, {0, 0, 5}, {i < 30 ? 1.0 : 0.0, 0, 0})}});
    tracks.push_back({stamp(i), {object(4, {0, 0, 5})}});
  }
  const TrackingError error = evaluate_tracking(truth, tracks, static_sensor());
  EXPECT_EQ(error.motion_state_changes, 1);
  EXPECT_NEAR(error.motion_state_delay_max, 59 * kPeriod, 1e-6);
}

TEST(TrackingError, FramesThatWereNotPlayedDoNotCount) {
  Trajectory played = static_sensor();
  played.resize(30);
  ObjectHistory tracks = two_walkers();
  tracks.resize(30);
  const TrackingError error =
      evaluate_tracking(frames_during(two_walkers(), played), tracks, static_sensor());
  EXPECT_EQ(error.objects, 60);
  EXPECT_EQ(error.recall, 1.0);
  EXPECT_EQ(error.idf1, 1.0);
}

TEST(TrackingError, TrackBelongsToTheObjectThatHadItLast) {
  const auto frame = [](int i, std::vector<ObjectBox> objects) {
    return ObjectFrame{stamp(i), std::move(objects)};
  };
  const ObjectHistory truth = {frame(0, {object(0, {0, 0, 5})}),
                               frame(1, {object(0, {9, 0, 5}), object(2, {0, 0, 5})}),
                               frame(2, {object(0, {0.9, 0, 5}), object(2, {0, 0, 5})})};
  const ObjectHistory tracks = {frame(0, {object(1, {0, 0, 5})}), frame(1, {object(1, {0, 0, 5})}),
                                frame(2, {object(1, {0, 0, 5}), object(7, {1.8, 0, 5})})};
  const TrackingError error = evaluate_tracking(truth, tracks, static_sensor());
  EXPECT_EQ(error.objects, 4) << "the one at 10 m is out of range";
  EXPECT_EQ(error.recall, 1.0);
  EXPECT_EQ(error.id_switches, 1);
}

TEST(TrackingError, IsNanWithoutObjects) {
  const TrackingError error = evaluate_tracking({}, {}, {});
  EXPECT_EQ(error.objects, 0);
  EXPECT_TRUE(std::isnan(error.idf1));
  EXPECT_TRUE(std::isnan(error.center_mean));
}

TEST(TransformedHistory, TransformsBoxesAndVelocities) {
  const Eigen::Isometry3d T(Eigen::Translation3d(1, 2, 3) *
                            Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitZ()));
  const ObjectHistory moved = transformed({{stamp(0), {object(0, {1, 0, 0})}}}, T);
  EXPECT_TRUE(moved[0].objects[0].center().isApprox(Eigen::Vector3d(1, 3, 3), 1e-12));
  EXPECT_TRUE(moved[0].objects[0].velocity.isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
}

}  // namespace
}  // namespace mms
