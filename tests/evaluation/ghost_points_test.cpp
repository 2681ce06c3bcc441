#include "mms/evaluation/map/ghost_points.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

/// Far mode of a pixel that sees a wall at 2 m in even frames, and one at 4 m in odd ones.
float far_mode_of(RoomDepth room, int frames) {
  for (int i = 0; i < frames; ++i) room.add(Image<float>(1, 1, i % 2 == 0 ? 2.0F : 4.0F));
  return room.far_mode()(0, 0);
}

TEST(RoomDepth, TakesTheFarMode) {
  EXPECT_FLOAT_EQ(far_mode_of(RoomDepth(), 40), 4.0F);
}

TEST(RoomDepth, BoundsThePixelsItKeeps) {
  EXPECT_FLOAT_EQ(far_mode_of(RoomDepth(40), 40), 4.0F);
  // The images do not fit: every second one is left.
  EXPECT_FLOAT_EQ(far_mode_of(RoomDepth(39), 40), 2.0F);
}

}  // namespace
}  // namespace mms
