#include "mms/segmentation/segmenters/mask_segmenter.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "mms/segmentation/segmenters/segmenter.hpp"

namespace mms {
namespace {

Frame frame_with(const std::vector<std::vector<int>>& rows) {
  Frame frame;
  frame.mask = Image<std::uint8_t>(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()));
  for (int y = 0; y < frame.mask.height(); ++y) {
    for (int x = 0; x < frame.mask.width(); ++x) {
      frame.mask(x, y) =
          static_cast<std::uint8_t>(rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]);
    }
  }
  return frame;
}

TEST(MaskSegmenter, OneInstancePerComponent) {
  const Frame frame = frame_with({{1, 0, 0, 0, 1},  //
                                  {0, 1, 0, 0, 0},  //
                                  {0, 0, 0, 1, 0},  //
                                  {1, 0, 1, 0, 0}});
  const Segmentation found = MaskSegmenter().segment(frame);
  EXPECT_EQ(found.width, 5);
  EXPECT_EQ(found.height, 4);
  ASSERT_EQ(found.instances.size(), 4U);
  EXPECT_EQ(found.instances[0].x, 0);
  EXPECT_EQ(found.instances[0].mask.width(), 2);
  EXPECT_EQ(found.instances[0].mask(1, 1), 1);
  EXPECT_EQ(found.instances[0].mask(1, 0), 0);
  EXPECT_EQ(found.instances[1].x, 4);
  EXPECT_EQ(found.instances[2].x, 2);
  EXPECT_EQ(found.instances[2].mask(1, 0), 1);
  EXPECT_EQ(found.instances[2].mask(0, 1), 1);
}

TEST(MaskSegmenter, JoinsArmsThatMeetBelow) {
  const Frame frame = frame_with({{1, 0, 1, 0, 1},  //
                                  {1, 0, 1, 0, 1},  //
                                  {1, 1, 1, 1, 1}});
  EXPECT_EQ(MaskSegmenter().segment(frame).instances.size(), 1U);
}

TEST(MaskSegmenter, SeparatesClassesAndMapsUnknownToPerson) {
  const Frame frame = frame_with({{1, 2, 255}});
  const Segmentation found = MaskSegmenter().segment(frame);
  ASSERT_EQ(found.instances.size(), 3U);
  EXPECT_EQ(found.instances[0].object_class, ObjectClass::kPerson);
  EXPECT_EQ(found.instances[1].object_class, ObjectClass::kAgv);
  EXPECT_EQ(found.instances[2].object_class, ObjectClass::kPerson);
}

TEST(MaskSegmenter, NoInstancesWithoutMask) {
  const Segmentation found = MaskSegmenter().segment(Frame());
  EXPECT_EQ(found.width, 0);
  EXPECT_TRUE(found.instances.empty());
}

TEST(MaskSegmenter, InstancesPartitionRandomMasks) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    Frame frame;
    frame.mask = Image<std::uint8_t>(40, 30);
    for (auto& pixel : frame.mask.pixels()) pixel = static_cast<std::uint8_t>(random() % 3);
    Image<std::uint8_t> rebuilt(40, 30);
    for (const Instance& instance : MaskSegmenter().segment(frame).instances) {
      for (int y = 0; y < instance.mask.height(); ++y) {
        for (int x = 0; x < instance.mask.width(); ++x) {
          if (instance.mask(x, y) == 0) continue;
          std::uint8_t& pixel = rebuilt(instance.x + x, instance.y + y);
          ASSERT_EQ(pixel, 0);
          pixel = static_cast<std::uint8_t>(1 + static_cast<int>(instance.object_class));
        }
      }
    }
    EXPECT_EQ(rebuilt.pixels(), frame.mask.pixels());
  }
}

TEST(NoneSegmenter, FindsNothing) {
  const Frame frame = frame_with({{1, 1}});
  EXPECT_TRUE(NoneSegmenter().segment(frame).instances.empty());
}

}  // namespace
}  // namespace mms
