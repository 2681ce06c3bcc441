#include "mms/geometry/trimmed_box.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

TEST(TrimmedBox, ExcludesOutliers) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 100; ++i) points.emplace_back(Eigen::Vector3f::Constant(float(i)));
  points.emplace_back(1e6F, -1e6F, 0.0F);
  const Eigen::AlignedBox3f box = trimmed_box(points, 0.02);
  EXPECT_EQ(box.min(), Eigen::Vector3f(2.0F, 1.0F, 1.0F));
  EXPECT_EQ(box.max(), Eigen::Vector3f(99.0F, 98.0F, 98.0F));
  const Eigen::AlignedBox3f whole = trimmed_box(points, 0.0);
  EXPECT_EQ(whole.max().x(), 1e6F);
}

TEST(TrimmedBox, EmptyWithoutPoints) {
  EXPECT_TRUE(trimmed_box({}, 0.1).isEmpty());
}

}  // namespace
}  // namespace mms
