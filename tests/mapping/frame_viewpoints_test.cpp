#include "mms/mapping/static_map/frame_viewpoints.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

FrameViewpoints viewpoints_of(int frames) {
  FrameViewpoints viewpoints;
  for (int i = 1; i <= frames; ++i) viewpoints.add({static_cast<float>(i), 0.0F, 0.0F});
  return viewpoints;
}

std::vector<bool> needed(std::uint32_t last, std::initializer_list<std::uint32_t> frames) {
  std::vector<bool> is_needed(last + 1);
  for (const std::uint32_t frame : frames) is_needed[frame] = true;
  return is_needed;
}

TEST(FrameViewpoints, AreFoundByFrameNumber) {
  const FrameViewpoints viewpoints = viewpoints_of(5);
  EXPECT_EQ(viewpoints.last(), 5U);
  for (std::uint32_t frame = 1; frame <= 5; ++frame) {
    EXPECT_EQ(viewpoints.at(frame).x(), static_cast<float>(frame));
  }
}

TEST(FrameViewpoints, PruningKeepsNeededFramesAndNumbers) {
  FrameViewpoints viewpoints = viewpoints_of(10);
  viewpoints.prune(needed(10, {2, 7}));
  EXPECT_EQ(viewpoints.size(), 2U);
  EXPECT_EQ(viewpoints.at(2).x(), 2.0F);
  EXPECT_EQ(viewpoints.at(7).x(), 7.0F);
  EXPECT_EQ(viewpoints.last(), 10U);
  viewpoints.add({11.0F, 0.0F, 0.0F});
  EXPECT_EQ(viewpoints.at(11).x(), 11.0F);
}

TEST(FrameViewpoints, WantPruningAfterDoubling) {
  FrameViewpoints viewpoints = viewpoints_of(4095);
  EXPECT_FALSE(viewpoints.wants_pruning());
  viewpoints.add(Eigen::Vector3f::Zero());
  EXPECT_TRUE(viewpoints.wants_pruning());
  viewpoints.prune(needed(4096, {1, 4096}));
  EXPECT_FALSE(viewpoints.wants_pruning());
}

}  // namespace
}  // namespace mms
