#include "mms/pipeline/mask_policy.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

Timestamp at(double seconds) {
  return Timestamp::from_seconds(100.0 + seconds);
}

TEST(MaskPolicy, GivesMasksToAllFramesWithoutDelay) {
  MaskPolicy policy(0.1);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(policy.wants_masks(at(0.033 * i), false));
}

TEST(MaskPolicy, RenewsMasksBeforeMaxAgeUnderDelay) {
  MaskPolicy policy(0.1);
  int with_masks = 0;
  double last = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double now = i / 30.0;
    if (!policy.wants_masks(at(now), true)) continue;
    EXPECT_LE(now - last, 0.1 + 1.0 / 30.0);
    ++with_masks;
    last = now;
  }
  EXPECT_GE(with_masks, 8);
  EXPECT_LE(with_masks, 10);
}

TEST(MaskPolicy, GivesMasksToAllFramesWithoutMaxAge) {
  MaskPolicy policy(0.0);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(policy.wants_masks(at(0.033 * i), true));
}

}  // namespace
}  // namespace mms
