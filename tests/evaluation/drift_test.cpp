#include "mms/evaluation/trajectory/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mms/core/error.hpp"
#include "tests/evaluation/trajectories.hpp"

namespace mms {
namespace {

TEST(Drift, IsMeanAndMaximumDistanceInMeters) {
  const Drift drift = evaluate_drift(test::along_x({5.0, 5.01, 4.98, 5.0}));
  EXPECT_EQ(drift.poses, 4U);
  EXPECT_NEAR(drift.atde_m, (0.0 + 0.01 + 0.02 + 0.0) / 4.0, 1e-9);
  EXPECT_NEAR(drift.mtde_m, 0.02, 1e-9);
}

TEST(Drift, IsZeroForOnePose) {
  EXPECT_EQ(evaluate_drift(test::along_x({3.0})).mtde_m, 0.0);
}

TEST(Drift, IgnoresNonFinitePoses) {
  const Drift drift = evaluate_drift(test::along_x({std::nan(""), 1.0, std::nan(""), 1.1}));
  EXPECT_EQ(drift.poses, 2U);
  EXPECT_NEAR(drift.mtde_m, 0.1, 1e-9);
}

TEST(Drift, RejectsEmptyTrajectory) {
  EXPECT_THROW(evaluate_drift({}), DataError);
  EXPECT_THROW(evaluate_drift(test::along_x({std::nan("")})), DataError);
}

TEST(Drift, JsonHasDocumentedKeys) {
  EXPECT_EQ(to_json(metric_values(Drift{3, 1.5, 2.5})), R"({"poses":3,"atde_m":1.5,"mtde_m":2.5})");
}

}  // namespace
}  // namespace mms
