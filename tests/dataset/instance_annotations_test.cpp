#include "mms/dataset/simulated/instance_annotations.hpp"

#include <gtest/gtest.h>

#include "tests/dataset/simulated_frames.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

/// A frame with only the first `pixels` pixels of the person visible.
SimulatedFrame frame_with(int pixels, double occlusion = 0.0) {
  SimulatedFrame frame = synthetic_frame(0, small_sensor());
  int remaining = pixels;
  for (std::uint8_t& value : frame.exact.object.pixels()) {
    if (value != 0 && remaining-- <= 0) value = 0;
  }
  frame.objects[0].pixels = pixels;
  frame.objects[0].occlusion = occlusion;
  return frame;
}

TEST(InstanceAnnotations, HaveImagesObjectsAndCategories) {
  CocoDataset dataset = empty_annotations();
  annotate(dataset, synthetic_frame(0, small_sensor()), 1, "rgb/a.jpg");
  annotate(dataset, synthetic_frame(1, small_sensor()), 2, "rgb/b.jpg");
  ASSERT_EQ(dataset.categories.size(), 2U);
  EXPECT_EQ(dataset.categories[0].name, "person");
  EXPECT_EQ(dataset.categories[1].name, "agv");
  ASSERT_EQ(dataset.images.size(), 2U);
  EXPECT_EQ(dataset.images[1].file_name, "rgb/b.jpg");
  ASSERT_EQ(dataset.annotations.size(), 2U);  // the vehicle is out of view
  const CocoAnnotation& person = dataset.annotations[1];
  EXPECT_EQ(person.id, 2);
  EXPECT_EQ(person.image_id, 2);
  EXPECT_EQ(person.category_id, 1);
  EXPECT_EQ(person.area, 16.0 * 24.0);
  EXPECT_EQ(person.bbox, (std::array{0.0, 0.0, 16.0, 24.0}));
  EXPECT_FALSE(person.iscrowd);
}

TEST(InstanceAnnotations, MarksOrOmitsSmallAndHiddenObjects) {
  const auto annotations = [](const SimulatedFrame& frame) {
    CocoDataset dataset = empty_annotations();
    annotate(dataset, frame, 1, "a.jpg");
    return dataset.annotations;
  };
  EXPECT_TRUE(annotations(frame_with(19)).empty());
  EXPECT_TRUE(annotations(frame_with(20)).at(0).iscrowd);
  EXPECT_TRUE(annotations(frame_with(59)).at(0).iscrowd);
  EXPECT_FALSE(annotations(frame_with(60)).at(0).iscrowd);
  EXPECT_TRUE(annotations(frame_with(100, 0.95)).at(0).iscrowd);
}

}  // namespace
}  // namespace mms
