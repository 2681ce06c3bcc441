#include "mms/run/view/corrected_frames.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "mms/geometry/se3.hpp"

namespace mms {
namespace {

using Global_World = Transform<Global, World>;

Eigen::Isometry3d some_pose(double scale) {
  Vector6d tangent;
  tangent << 0.4, -0.2, 0.7, 0.1, 0.5, -0.2;
  return se3::exp(scale * tangent);
}

/// Frames 10 s apart, each with an object before the sensor.
SceneFrames some_frames(std::size_t count) {
  SceneFrames frames;
  for (std::size_t i = 0; i < count; ++i) {
    auto frame = std::make_shared<SceneFrame>();
    frame->stamp = Timestamp::from_seconds(10.0 * static_cast<double>(i));
    frame->T_world_sensor = Transform<World, Sensor>(some_pose(static_cast<double>(i)));
    frame->objects.emplace_back().T_world_box =
        frame->T_world_sensor.isometry() * Eigen::Translation3d(0.0, 0.0, 2.0);
    frames.push_back(frame);
  }
  return frames;
}

/// The drift is linear in time up to the present, 20 s.
MapCorrection correction_of(double drift) {
  SessionPlace place;
  for (const double share : {0.0, 0.5, 1.0}) {
    place.correction.add(Timestamp::from_seconds(20.0 * share),
                         Global_World(some_pose(share * drift)));
  }
  return {Global_World(some_pose(drift)),
          std::make_shared<const std::vector<SessionPlace>>(std::vector{place}), nullptr};
}

void expect_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  EXPECT_TRUE(a.isApprox(b, 1e-9)) << a.matrix() << "\n" << b.matrix();
}

TEST(CorrectedFrames, MoveThePastAndKeepThePresent) {
  const SceneFrames shown = some_frames(3);
  const SceneFrames frames = corrected_frames(shown, {0, 0, 0}, {}, 0, correction_of(0.1));
  ASSERT_EQ(frames.size(), 3U);
  expect_near(frames[2]->T_world_sensor.isometry(), shown[2]->T_world_sensor.isometry());
  expect_near(frames[0]->T_world_sensor.isometry(),
              some_pose(0.1).inverse() * shown[0]->T_world_sensor.isometry());
  for (const auto& frame : frames) {
    expect_near(frame->objects.at(0).T_world_box,
                frame->T_world_sensor.isometry() * Eigen::Translation3d(0.0, 0.0, 2.0));
  }
}

TEST(CorrectedFrames, ASecondCorrectionReplacesTheFirst) {
  const SceneFrames shown = some_frames(3);
  const std::vector<std::uint32_t> sessions = {0, 0, 0};
  SceneFrames twice = corrected_frames({shown[0], shown[1]}, sessions, {}, 0, correction_of(0.1));
  twice.push_back(shown[2]);
  twice = corrected_frames(twice, sessions, correction_of(0.1), 2, correction_of(0.2));
  const SceneFrames once = corrected_frames(shown, sessions, {}, 0, correction_of(0.2));
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(twice[i]->T_world_sensor.isometry(), once[i]->T_world_sensor.isometry());
  }
}

TEST(CorrectedFrames, SessionsWithoutAPlaceStay) {
  const SceneFrames shown = some_frames(3);
  MapCorrection correction = correction_of(0.1);
  auto places = *correction.places;
  places.push_back({.is_known = false, .correction = {}});
  correction.places = std::make_shared<const std::vector<SessionPlace>>(places);
  const SceneFrames frames = corrected_frames(shown, {1, 0, 2}, {}, 0, correction);
  EXPECT_EQ(frames[0]->T_world_sensor.isometry().matrix(),
            shown[0]->T_world_sensor.isometry().matrix());
  EXPECT_EQ(frames[2]->T_world_sensor.isometry().matrix(),
            shown[2]->T_world_sensor.isometry().matrix());
  EXPECT_FALSE(
      frames[1]->T_world_sensor.isometry().isApprox(shown[1]->T_world_sensor.isometry(), 1e-6));
}

TEST(CorrectedFrames, LoopsHaveTheNumbersOfTheirFrames) {
  const auto at = [](double seconds) { return Timestamp::from_seconds(seconds); };
  const std::vector<SceneLoop> loops =
      loops_between(some_frames(3), {{at(0.0), at(20.0)}, {at(10.0), at(30.0)}});
  ASSERT_EQ(loops.size(), 1U) << "frame 3 is not shown yet";
  EXPECT_EQ(loops[0].earlier, 0U);
  EXPECT_EQ(loops[0].later, 2U);
  EXPECT_TRUE(loops[0].is_accepted);
}

}  // namespace
}  // namespace mms
