#include "mms/ros/transform_tree.hpp"

#include <gtest/gtest.h>

namespace mms {
namespace {

msg::TransformStamped transform(const char* parent, const char* child, Timestamp stamp, double x) {
  msg::TransformStamped message;
  message.header = {0, stamp, parent};
  message.child_frame_id = child;
  message.transform.position = {x, 0.0, 0.0};
  return message;
}

TransformTree robot() {
  TransformTree tree;
  tree.add({{transform("/base", "/camera", Timestamp(0), 0.1),
             transform("base", "lidar", Timestamp(0), 0.5),
             transform("world", "base", Timestamp(10), 1.0),
             transform("world", "base", Timestamp(20), 2.0)}});
  return tree;
}

TEST(TransformTree, LooksUpAcrossTree) {
  const TransformTree tree = robot();
  EXPECT_NEAR(tree.lookup("world", "camera", Timestamp(12))->translation().x(), 1.3, 1e-12);
  EXPECT_NEAR(tree.lookup("world", "camera", Timestamp(99))->translation().x(), 2.1, 1e-12);
  EXPECT_NEAR(tree.lookup("camera", "lidar", Timestamp(0))->translation().x(), 0.4, 1e-12);
  EXPECT_NEAR(tree.lookup("camera", "world", Timestamp(0))->translation().x(), -1.1, 1e-12);
  EXPECT_FALSE(tree.lookup("camera", "other", Timestamp(0)));
}

TEST(TransformTree, FindsRootAndStampsOfMovingFrames) {
  const TransformTree tree = robot();
  EXPECT_EQ(tree.root_of("camera"), "world");
  EXPECT_EQ(tree.root_of("other"), "other");
  EXPECT_EQ(tree.stamps_above("camera"), (std::vector<Timestamp>{Timestamp(10), Timestamp(20)}));
  EXPECT_TRUE(tree.stamps_above("other").empty());
}

TEST(TransformTree, ToleratesCyclesAndNans) {
  TransformTree tree;
  tree.add({{transform("a", "b", Timestamp(0), 1.0), transform("b", "a", Timestamp(0), 1.0),
             transform("b", "c", Timestamp(0), NAN)}});
  EXPECT_TRUE(tree.lookup("a", "b", Timestamp(0)));
  EXPECT_FALSE(tree.lookup("a", "c", Timestamp(0)));
}

TEST(TransformTree, PosesRoundTrip) {
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized());
  EXPECT_TRUE(isometry_of(pose_message(pose)).isApprox(pose, 1e-12));
}

TEST(TransformTree, KeepsTheLatestTransforms) {
  TransformTree tree(2);
  for (int i = 0; i < 5; ++i) tree.add({{transform("odom", "base", Timestamp(i), i)}});
  EXPECT_EQ(tree.stamps_above("base"), (std::vector<Timestamp>{Timestamp(3), Timestamp(4)}));
  for (int i = 0; i < 2; ++i) tree.add({{transform("odom", "base", Timestamp(i), i)}});
  EXPECT_EQ(tree.stamps_above("base"), (std::vector<Timestamp>{Timestamp(0), Timestamp(1)}));
}

}  // namespace
}  // namespace mms
