#include "mms/run/view/frame_correction.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

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
std::vector<SceneFrame> some_frames(std::size_t count) {
  std::vector<SceneFrame> frames;
  for (std::size_t i = 0; i < count; ++i) {
    SceneFrame& frame = frames.emplace_back();
    frame.stamp = Timestamp::from_seconds(10.0 * static_cast<double>(i));
    frame.T_world_sensor = Transform<World, Sensor>(some_pose(static_cast<double>(i)));
    frame.objects.emplace_back().T_world_box =
        frame.T_world_sensor.isometry() * Eigen::Translation3d(0.0, 0.0, 2.0);
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

/// Frames corrected in order.
std::vector<SceneFrame> corrected(std::vector<SceneFrame> frames,
                                  const std::vector<std::uint32_t>& sessions,
                                  const MapCorrection& now) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    correct_frame(frames[i], sessions[i], nullptr, now);
  }
  return frames;
}

TEST(FrameCorrection, MovesThePastAndKeepsThePresent) {
  const std::vector<SceneFrame> shown = some_frames(3);
  const std::vector<SceneFrame> frames = corrected(shown, {0, 0, 0}, correction_of(0.1));
  expect_near(frames[2].T_world_sensor.isometry(), shown[2].T_world_sensor.isometry());
  expect_near(frames[0].T_world_sensor.isometry(),
              some_pose(0.1).inverse() * shown[0].T_world_sensor.isometry());
  for (const SceneFrame& frame : frames) {
    expect_near(frame.objects.at(0).T_world_box,
                frame.T_world_sensor.isometry() * Eigen::Translation3d(0.0, 0.0, 2.0));
  }
}

TEST(FrameCorrection, ASecondCorrectionReplacesTheFirst) {
  const MapCorrection first = correction_of(0.1);
  const MapCorrection second = correction_of(0.2);
  std::vector<SceneFrame> twice = some_frames(3);
  for (const std::size_t i : {0U, 1U}) correct_frame(twice[i], 0, nullptr, first);
  for (const std::size_t i : {0U, 1U, 2U}) {
    correct_frame(twice[i], 0, i < 2 ? &first : nullptr, second);
  }
  const std::vector<SceneFrame> once = corrected(some_frames(3), {0, 0, 0}, second);
  for (std::size_t i = 0; i < 3; ++i) {
    expect_near(twice[i].T_world_sensor.isometry(), once[i].T_world_sensor.isometry());
  }
}

TEST(FrameCorrection, SessionsWithoutAPlaceStay) {
  const std::vector<SceneFrame> shown = some_frames(3);
  MapCorrection correction = correction_of(0.1);
  auto places = *correction.places;
  places.push_back({.is_known = false, .correction = {}});
  correction.places = std::make_shared<const std::vector<SessionPlace>>(places);
  const std::vector<SceneFrame> frames = corrected(shown, {1, 0, 2}, correction);
  const auto matrix = [](const SceneFrame& frame) {
    return frame.T_world_sensor.isometry().matrix();
  };
  EXPECT_EQ(matrix(frames[0]), matrix(shown[0]));
  EXPECT_EQ(matrix(frames[2]), matrix(shown[2]));
  EXPECT_FALSE(matrix(frames[1]).isApprox(matrix(shown[1]), 1e-6));
}

TEST(FrameCorrection, LoopsHaveTheNumbersOfTheirFrames) {
  const auto at = [](double seconds) { return Timestamp::from_seconds(seconds); };
  const std::vector<SceneLoop> loops =
      loops_between({at(0.0), at(10.0), at(20.0)}, {{at(0.0), at(20.0)}, {at(10.0), at(30.0)}});
  ASSERT_EQ(loops.size(), 1U) << "frame 3 is not shown yet";
  EXPECT_EQ(loops[0].earlier, 0U);
  EXPECT_EQ(loops[0].later, 2U);
  EXPECT_TRUE(loops[0].is_accepted);
}

}  // namespace
}  // namespace mms
