#include "mms/ros/growing_path.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace mms {
namespace {

/// Adds poses at x = begin, ..., end - 1.
void add(GrowingPath& path, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    msg::Pose pose;
    pose.position = {static_cast<double>(i), 0.0, 0.0};
    path.add({0, Timestamp(static_cast<std::int64_t>(i)), "world"}, pose);
  }
}

/// Where the kept poses are, but the latest one.
std::vector<std::size_t> places_of(const GrowingPath& path) {
  std::vector<std::size_t> places;
  const auto& poses = path.message().poses;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    places.push_back(static_cast<std::size_t>(poses[i].pose.position[0]));
  }
  return places;
}

TEST(GrowingPath, KeepsAllPosesWhileThereIsRoom) {
  GrowingPath path;
  EXPECT_TRUE(path.message().poses.empty());
  add(path, 0, GrowingPath::kMaxPoses);
  const msg::Path& message = path.message();
  ASSERT_EQ(message.poses.size(), GrowingPath::kMaxPoses);
  EXPECT_EQ(message.header.frame_id, "world");
  EXPECT_EQ(message.header.stamp, Timestamp(9'999));
  for (std::size_t i = 0; i < message.poses.size(); ++i) {
    EXPECT_EQ(message.poses[i].header.stamp, Timestamp(static_cast<std::int64_t>(i)));
  }
}

TEST(GrowingPath, IsThinnedEvenlyUpToTheLatestPose) {
  GrowingPath path;
  std::size_t added = 0;
  for (const std::size_t count : {10'001U, 10'002U, 10'003U, 20'001U, 35'000U, 39'999U, 100'000U}) {
    add(path, added, count);
    added = count;
    const auto& poses = path.message().poses;
    ASSERT_LE(poses.size(), GrowingPath::kMaxPoses) << count;
    ASSERT_GE(poses.size(), GrowingPath::kMaxPoses / 2) << count;
    EXPECT_EQ(poses.back().pose.position[0], static_cast<double>(count - 1));
    const std::vector<std::size_t> places = places_of(path);
    const std::size_t stride = places[1];
    for (std::size_t i = 0; i < places.size(); ++i) ASSERT_EQ(places[i], i * stride) << count;
    EXPECT_LE(count - 1 - places.back(), stride) << "the latest pose follows the kept ones";
  }
}

}  // namespace
}  // namespace mms
