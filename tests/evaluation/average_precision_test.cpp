#include "mms/evaluation/segmentation/average_precision.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mms {
namespace {

constexpr Verdict kHit = Verdict::kHit;
constexpr Verdict kFalseAlarm = Verdict::kFalseAlarm;
constexpr Verdict kIgnored = Verdict::kIgnored;
constexpr double kTolerance = 1e-14;

void expect_curve(const std::vector<Verdict>& verdicts, std::size_t objects, double precision,
                  double recall) {
  const PrecisionRecall curve = average_precision(verdicts, objects);
  EXPECT_NEAR(curve.precision, precision, kTolerance);
  EXPECT_NEAR(curve.recall, recall, kTolerance);
}

TEST(AveragePrecision, IsMeanOver101Recalls) {
  expect_curve({kHit}, 1, 1.0, 1.0);
  expect_curve({kHit}, 2, 51.0 / 101.0, 0.5);              // recalls 0 to 0.50
  expect_curve({kHit, kHit}, 3, 67.0 / 101.0, 2.0 / 3.0);  // 0 to 0.66
  expect_curve({kFalseAlarm, kHit}, 1, 0.5, 1.0);
  expect_curve({kHit, kFalseAlarm}, 1, 1.0, 1.0);
  expect_curve({kHit, kFalseAlarm, kHit}, 2, (51.0 + 50.0 * 2.0 / 3.0) / 101.0, 1.0);
}

TEST(AveragePrecision, IsMonotoneOverRecall) {
  expect_curve({kFalseAlarm, kHit, kHit, kHit}, 3, 0.75, 1.0);
}

TEST(AveragePrecision, IgnoredVerdictsDoNotCount) {
  expect_curve({kIgnored, kHit, kIgnored, kFalseAlarm, kIgnored, kHit, kIgnored}, 2,
               (51.0 + 50.0 * 2.0 / 3.0) / 101.0, 1.0);
  expect_curve({kIgnored}, 1, 0.0, 0.0);
}

TEST(AveragePrecision, IsZeroWithoutHits) {
  expect_curve({}, 3, 0.0, 0.0);
  expect_curve({kFalseAlarm}, 3, 0.0, 0.0);
}

TEST(AveragePrecision, IsNanWithoutObjects) {
  EXPECT_TRUE(std::isnan(average_precision({kFalseAlarm}, 0).precision));
  EXPECT_TRUE(std::isnan(average_precision({}, 0).recall));
}

}  // namespace
}  // namespace mms
