#include "mms/segmentation/engine/memory_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mms::engine {
namespace {

bool overlap_in_time(const Lifetime& a, const Lifetime& b) {
  return a.first <= b.last && b.first <= a.last;
}

TEST(MemoryPlan, ReusesMemoryOfDisjointLifetimes) {
  const MemoryPlan plan = plan_memory({{1000, 0, 1}, {1000, 2, 3}, {500, 4, 9}});
  EXPECT_EQ(plan.bytes, 1024U);
  EXPECT_EQ(plan.offsets, (std::vector<std::size_t>{0, 0, 0}));
}

TEST(MemoryPlan, FillsGapBetweenBuffers) {
  // The fourth buffer fits into the memory of the second, whose lifetime is over.
  const MemoryPlan plan = plan_memory({{640, 0, 9}, {128, 0, 3}, {256, 0, 9}, {128, 4, 9}});
  EXPECT_EQ(plan.bytes, 640U + 256U + 128U);
  EXPECT_EQ(plan.offsets[3], plan.offsets[1]);
}

TEST(MemoryPlan, DoesNotOverlapSimultaneousBuffers) {
  std::mt19937 generator(3);
  for (int round = 0; round < 200; ++round) {
    std::vector<Lifetime> buffers(30);
    for (Lifetime& buffer : buffers) {
      buffer.bytes = 1 + generator() % 5000;
      buffer.first = static_cast<int>(generator() % 20);
      buffer.last = buffer.first + static_cast<int>(generator() % 6);
    }
    const MemoryPlan plan = plan_memory(buffers);
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      EXPECT_EQ(plan.offsets[i] % kAlignment, 0U);
      EXPECT_LE(plan.offsets[i] + buffers[i].bytes, plan.bytes);
      for (std::size_t j = 0; j < i; ++j) {
        if (!overlap_in_time(buffers[i], buffers[j])) continue;
        const bool are_disjoint = plan.offsets[i] + buffers[i].bytes <= plan.offsets[j] ||
                                  plan.offsets[j] + buffers[j].bytes <= plan.offsets[i];
        EXPECT_TRUE(are_disjoint) << i << " and " << j << " in round " << round;
      }
    }
  }
}

}  // namespace
}  // namespace mms::engine
