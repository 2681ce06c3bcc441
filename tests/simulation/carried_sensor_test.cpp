#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/geometry/se3.hpp"
#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

SceneConfig kidnap(int seed) {
  SceneConfig config = scene_config("kidnap");
  config.width = 160;
  config.seed = seed;
  return config;
}

/// First frame at or after a time [s].
int frame_at(const SceneConfig& config, double seconds) {
  return static_cast<int>(std::ceil(seconds * config.hz - 1e-9));
}

/// Share of the view that persons cover.
double cover(const SimulatedFrame& frame) {
  const auto& mask = frame.frame.mask.pixels();
  const auto persons = std::count(mask.begin(), mask.end(), 1);
  return static_cast<double>(persons) / static_cast<double>(mask.size());
}

TEST(CarriedSensor, IsDarkFromTimeToTime) {
  const SceneConfig config = kidnap(1);
  SimulatedScene scene(config);
  for (int i = 0; i < 3; ++i) {
    const double begin = config.dark_from + i * (config.dark_for + config.light_for);
    const int first = frame_at(config, begin);
    const int light = frame_at(config, begin + config.dark_for);
    for (const int index : {first, light - 1}) {
      const SimulatedFrame frame = scene.render(index);
      for (const float z : frame.frame.depth.pixels()) ASSERT_EQ(z, 0.0F);
      for (const Rgb& color : frame.frame.color.pixels()) ASSERT_LT(color.g, 40);
      EXPECT_EQ(cover(frame), 0.0);
    }
    for (const int index : {first - 1, light}) {
      const SimulatedFrame frame = scene.render(index);
      const auto& depth = frame.frame.depth.pixels();
      const auto measured =
          std::count_if(depth.begin(), depth.end(), [](float z) { return z > 0; });
      EXPECT_GT(static_cast<double>(measured), 0.5 * static_cast<double>(depth.size()));
    }
  }
}

TEST(CarriedSensor, NothingIsVisibleInTheDark) {
  const SceneConfig config = kidnap(1);
  SimulatedScene scene(config);
  const SimulatedFrame frame = scene.render(frame_at(config, config.dark_from + 1.0));
  for (const std::uint8_t object : frame.exact.object.pixels()) ASSERT_EQ(object, 0);
  for (const ObjectTruth& object : frame.objects) EXPECT_EQ(object.pixels, 0);
}

TEST(CarriedSensor, IsPutDownAtEarlierPlace) {
  double farthest = 0.0;
  for (int seed = 1; seed <= 4; ++seed) {
    const SceneConfig config = kidnap(seed);
    const SimulatedScene scene(config);
    const auto pose = [&](int index) { return scene.truth(index).T_world_sensor.isometry(); };
    for (double begin = config.dark_from; begin < config.duration;
         begin += config.dark_for + config.light_for) {
      const Eigen::Isometry3d T_sensor_world =
          pose(frame_at(config, begin + config.dark_for)).inverse();
      double nearest = 1e9;
      for (int i = 0; i < frame_at(config, config.dark_from); ++i) {
        const Eigen::Isometry3d relative = T_sensor_world * pose(i);
        // Beside its way by 0.3 m in two directions, with a pan of 0.12 rad to either side.
        if (se3::angle(relative) < 0.3) nearest = std::min(nearest, relative.translation().norm());
      }
      EXPECT_LT(nearest, 0.5) << seed << " " << begin;
      const Eigen::Isometry3d before = pose(frame_at(config, begin) - 1);
      farthest = std::max(farthest, (T_sensor_world * before).translation().norm());
    }
  }
  EXPECT_GT(farthest, 10.0);
}

TEST(CarriedSensor, MovesSmoothlyInTheLight) {
  const SceneConfig config = kidnap(2);
  const SimulatedScene scene(config);
  int checked = 0;
  for (int i = 1; i < scene.size(); ++i) {
    const double since =
        std::fmod(i / config.hz - config.dark_from, config.dark_for + config.light_for);
    if (i / config.hz >= config.dark_from && since < config.dark_for + 0.1) continue;
    const Eigen::Isometry3d motion =
        (scene.truth(i - 1).T_world_sensor.inverse() * scene.truth(i).T_world_sensor).isometry();
    EXPECT_LT(motion.translation().norm(), 0.12) << i;
    EXPECT_LT(se3::angle(motion), 0.15) << i;
    ++checked;
  }
  EXPECT_GT(checked, 1000);
}

TEST(CarriedSensor, PeopleCoverAboutHalfOfTheViewInTheLight) {
  double sum = 0.0;
  int count = 0;
  for (int seed = 1; seed <= 3; ++seed) {
    const SceneConfig config = kidnap(seed);
    SimulatedScene scene(config);
    EXPECT_LT(cover(scene.render(300)), 0.3) << "before";
    for (double light = config.dark_from + config.dark_for; light < config.duration;
         light += config.dark_for + config.light_for) {
      sum += cover(scene.render(frame_at(config, light)));
      ++count;
    }
  }
  EXPECT_GT(sum / count, 0.4);
  EXPECT_LT(sum / count, 0.6);
}

TEST(CarriedSensor, RefusesWheels) {
  SceneConfig config = kidnap(1);
  config.wheels.enabled = true;
  EXPECT_THROW(SimulatedScene{config}, DataError);
}

}  // namespace
}  // namespace mms
