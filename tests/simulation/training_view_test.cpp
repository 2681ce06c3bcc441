#include "mms/simulation/training_view.hpp"

#include <gtest/gtest.h>

#include <set>

namespace mms {
namespace {

TEST(TrainingViews, ImagesAreIndependent) {
  TrainingViews views(3);
  views.render(0);
  const SimulatedFrame a = views.render(9);
  const SimulatedFrame b = TrainingViews(3).render(9);
  EXPECT_EQ(a.frame.color.pixels(), b.frame.color.pixels());
  EXPECT_EQ(a.frame.mask.pixels(), b.frame.mask.pixels());
  EXPECT_NE(a.frame.color.pixels(), TrainingViews(4).render(9).frame.color.pixels());
}

TEST(TrainingViews, CoverClassesDistancesAndOcclusions) {
  TrainingViews views(1);
  int objects = 0;
  int persons = 0;
  int truncated = 0;
  int occluded = 0;
  int near_objects = 0;
  int far_objects = 0;
  std::set<std::string> kinds;
  for (int i = 0; i < 48; ++i) {
    const SimulatedFrame frame = views.render(i);
    EXPECT_EQ(frame.frame.color.width(), 640);
    EXPECT_TRUE(frame.frame.mask.same_size(frame.frame.color));
    for (const ObjectTruth& object : frame.objects) {
      if (object.pixels < 50) continue;
      ++objects;
      kinds.insert(object.kind);
      persons += object.object_class == ObjectClass::kPerson ? 1 : 0;
      truncated += object.truncation > 0.1 ? 1 : 0;
      occluded += object.occlusion > 0.1 ? 1 : 0;
      const double distance = object.T_world_box.translation().norm();
      near_objects += distance < 2.0 ? 1 : 0;
      far_objects += distance > 6.0 ? 1 : 0;
      EXPECT_LT(distance, 13.5);
    }
  }
  EXPECT_GT(objects, 60);
  EXPECT_GT(persons, 20);
  EXPECT_GT(objects - persons, 15);
  EXPECT_GT(truncated, 8);
  EXPECT_GT(occluded, 8);
  EXPECT_GT(near_objects, 5);
  EXPECT_GT(far_objects, 5);
  EXPECT_GE(kinds.size(), 5U);
}

}  // namespace
}  // namespace mms
