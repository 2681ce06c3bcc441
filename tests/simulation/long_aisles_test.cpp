#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "mms/simulation/simulated_scene.hpp"

namespace mms {
namespace {

constexpr double kAisle = 31.8;  // way along an aisle [m]
constexpr double kCross = 6.8;   // way from one aisle to the next [m]

struct View {
  Image<float> surfaces;  ///< mean color of that at each pixel
  double center = 0.0;    ///< column of the principal point [px]
};

/// The view without people from a place of the lane.
View view_from(double start, int day = 0) {
  SceneConfig config = scene_config("long_aisles");
  config.crossing = config.leading = config.oncoming = config.working = config.agvs = 0;
  config.width = 160;
  config.start = start;
  config.day = day;
  SimulatedScene scene(config);
  return {scene.render(0).exact.reflectance, scene.calibration().camera->cx};
}

/// Share of the pixels with the same surface.
double likeness(const View& a, const View& b, bool mirrored = false) {
  int same = 0;
  int all = 0;
  for (int y = 0; y < a.surfaces.height(); ++y) {
    for (int x = 0; x < a.surfaces.width(); ++x) {
      const int other = mirrored ? static_cast<int>(std::lround(2.0 * b.center)) - x : x;
      if (!b.surfaces.contains(other, y)) continue;
      same += std::abs(a.surfaces(x, y) - b.surfaces(other, y)) < 1e-3F ? 1 : 0;
      ++all;
    }
  }
  return static_cast<double>(same) / static_cast<double>(all);
}

TEST(LongAisles, AislesLookAlike) {
  const double place = 8.0;
  const View first = view_from(place);
  const View mirrored = view_from(place + kAisle + kCross);
  const View third = view_from(place + 2.0 * (kAisle + kCross));
  const View turned = view_from(place + 3.0 * (kAisle + kCross));
  // Racks, floor and walls are the same in any case.
  const double unlike = likeness(first, mirrored);
  for (const View* other : {&third, &turned}) {
    EXPECT_GT(likeness(first, *other), unlike + 0.05);
    EXPECT_LT(likeness(first, *other), 0.99);
  }
  // The second aisle is driven the other way: its left side is the right one of the first aisle.
  EXPECT_GT(likeness(first, mirrored, true), unlike + 0.05);
}

TEST(LongAisles, OtherDaysChangeSomeLoads) {
  // The start of another day is 2 m further.
  const double same = likeness(view_from(8.0), view_from(6.0, 1));
  EXPECT_GT(same, 0.6);
  EXPECT_LT(same, 0.99);
}

TEST(LongAisles, EveryPlaceIsSeenTwiceSomeFromBothDirections) {
  const SceneConfig config = scene_config("long_aisles");
  const SimulatedScene scene(config);
  double path = 0.0;
  std::array<std::vector<double>, 4> headings;  // by aisle: of each visit of its center
  for (int i = 1; i < scene.size(); ++i) {
    const auto before = scene.truth(i - 1).T_world_sensor.isometry();
    const auto now = scene.truth(i).T_world_sensor.isometry();
    path += (now.translation() - before.translation()).norm();
    // The first frame is at the corner (-15.9, -10.2), x ahead; world: x right, z ahead.
    const Eigen::Vector3d a = before.translation();
    const Eigen::Vector3d b = now.translation();
    if ((a.z() < kAisle / 2.0) == (b.z() < kAisle / 2.0)) continue;
    const auto aisle = static_cast<std::size_t>(std::lround(-b.x() / kCross));
    ASSERT_LT(aisle, 4U);
    headings[aisle].push_back(b.z() - a.z());
  }
  EXPECT_GT(path, 300.0);
  int both = 0;
  for (const std::vector<double>& visits : headings) {
    EXPECT_EQ(visits.size(), 2U);
    both += visits.front() * visits.back() < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(both, 2);
  EXPECT_LT(scene.truth(scene.size() - 1).T_world_sensor.translation().norm(), 6.0);
}

TEST(LongAisles, PeopleAndVehiclesAreInAllParts) {
  SceneConfig config = scene_config("long_aisles");
  config.width = 160;
  SimulatedScene scene(config);
  constexpr int kParts = 8;
  int vehicles = 0;
  for (int part = 0; part < kParts; ++part) {
    int people = 0;
    for (int i = 0; i < 6; ++i) {
      for (const ObjectTruth& object : scene.render((6 * part + i) * scene.size() / 48).objects) {
        if (object.pixels < 20) continue;
        ++(object.object_class == ObjectClass::kPerson ? people : vehicles);
      }
    }
    EXPECT_GT(people, 3) << part;
  }
  EXPECT_GT(vehicles, 5);
}

}  // namespace
}  // namespace mms
