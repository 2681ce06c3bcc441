#include "mms/io/journal/disk_log.hpp"

#include <gtest/gtest.h>

#include "mms/geometry/se3.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::TempFolder;

Eigen::Isometry3d some_pose(int i) {
  Vector6d tangent;
  tangent << 0.1, -0.2, 0.3, 0.02, -0.01, 0.03;
  return se3::exp(i * tangent);
}

TEST(DiskLog, GivesTheObjectsAsTheyWere) {
  const TempFolder folder;
  DiskLog<ObjectFrame> log(folder.path());
  for (int i = 0; i < 5; ++i) {
    ObjectFrame frame{Timestamp(i), {}};
    for (int id = 0; id < i; ++id) {
      ObjectBox& box = frame.objects.emplace_back();
      box.id = id;
      box.object_class = ObjectClass::kAgv;
      box.T_world_box = some_pose(id);
      box.size = Eigen::Vector3d(1.0, 2.0, id);
      box.velocity = Eigen::Vector3d(-1.0, 0.5, i);
      box.moving = id % 2 == 0;
      box.score = 0.25;
    }
    log.add(frame);
  }
  EXPECT_EQ(log.size(), 5U);
  const ObjectHistory history = log.read();
  ASSERT_EQ(history.size(), 5U);
  for (int i = 0; i < 5; ++i) {
    const ObjectFrame& frame = history[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.stamp, Timestamp(i));
    ASSERT_EQ(frame.objects.size(), static_cast<std::size_t>(i));
    for (int id = 0; id < i; ++id) {
      const ObjectBox& box = frame.objects[static_cast<std::size_t>(id)];
      EXPECT_EQ(box.id, id);
      EXPECT_EQ(box.object_class, ObjectClass::kAgv);
      EXPECT_EQ(box.T_world_box.matrix(), some_pose(id).matrix());
      EXPECT_EQ(box.size, Eigen::Vector3d(1.0, 2.0, id));
      EXPECT_EQ(box.velocity, Eigen::Vector3d(-1.0, 0.5, i));
      EXPECT_EQ(box.moving, id % 2 == 0);
      EXPECT_EQ(box.score, 0.25);
      EXPECT_EQ(box.visible, 1.0);
    }
  }
}

/// A frame with `index % 3` objects.
ObjectFrame frame_at(std::size_t index) {
  ObjectFrame frame{Timestamp(static_cast<std::int64_t>(index)), {}};
  frame.objects.resize(index % 3);
  return frame;
}

TEST(DiskLog, GivesEachRange) {
  constexpr std::size_t kRecords = 3000;  // more than are kept in memory before they are written
  const TempFolder folder;
  for (const std::filesystem::path& place : {folder.path(), std::filesystem::path()}) {
    DiskLog<ObjectFrame> log(place);
    for (std::size_t i = 0; i < kRecords; ++i) log.add(frame_at(i));
    for (const std::size_t first : {0, 1, 7, 1500, 2500, 2999}) {
      for (const std::size_t count : {1, 2, 400, 3000}) {
        const ObjectHistory range = log.read(first, first + count);
        ASSERT_EQ(range.size(), std::min(count, kRecords - first));
        for (std::size_t i = 0; i < range.size(); ++i) {
          EXPECT_EQ(range[i].stamp, frame_at(first + i).stamp);
          EXPECT_EQ(range[i].objects.size(), (first + i) % 3);
        }
      }
    }
    EXPECT_TRUE(log.read(kRecords, kRecords + 1).empty());
    EXPECT_TRUE(log.read(2, 1).empty());
  }
}

}  // namespace
}  // namespace mms
