#include "mms/geometry/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/geometry/threads.hpp"

namespace mms {
namespace {

/// Numbers whose float sum depends on the order of addition.
std::vector<float> order_dependent_numbers(int count) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> exponent(-6.0F, 6.0F);
  std::vector<float> numbers;
  for (int i = 0; i < count; ++i) {
    numbers.push_back((i % 2 == 0 ? 1.0F : -1.0F) * std::pow(10.0F, exponent(random)));
  }
  return numbers;
}

float sum_of(const std::vector<float>& numbers) {
  return parallel_sum(numbers.size(), 64, 0.0F, [&](std::size_t begin, std::size_t end) {
    float sum = 0.0F;
    for (std::size_t i = begin; i < end; ++i) sum += numbers[i];
    return sum;
  });
}

TEST(ParallelSum, SameBitsForAnyThreadCount) {
  const auto numbers = order_dependent_numbers(20001);
  const auto bits = [&](int threads) {
    return testing::on_threads(threads,
                               [&] { return std::bit_cast<std::uint32_t>(sum_of(numbers)); });
  };
  const std::uint32_t expected = bits(1);
  for (int repeat = 0; repeat < 10; ++repeat) {
    EXPECT_EQ(bits(2), expected);
    EXPECT_EQ(bits(4), expected);
  }
}

TEST(ParallelSum, AddsEveryIndexOnce) {
  for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 1000U}) {
    const auto sum =
        parallel_sum(count, 64, std::size_t{0}, [](std::size_t begin, std::size_t end) {
          std::size_t part = 0;
          for (std::size_t i = begin; i < end; ++i) part += i;
          return part;
        });
    EXPECT_EQ(sum, count < 2 ? 0 : count * (count - 1) / 2);
  }
}

TEST(ParallelChunks, CoverEveryIndexOnce) {
  std::vector<std::atomic<int>> visits(1001);
  std::atomic<bool> aligned = true;
  testing::on_threads(4, [&] {
    parallel_chunks(visits.size(), 50, [&](std::size_t begin, std::size_t end) {
      if (begin % 50 != 0 || end - begin > 50 || begin >= end) aligned = false;
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    return 0;
  });
  EXPECT_TRUE(aligned);
  for (const auto& count : visits) EXPECT_EQ(count, 1);
}

}  // namespace
}  // namespace mms
