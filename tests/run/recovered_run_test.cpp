#include "mms/run/record/recovered_run.hpp"

#include <gtest/gtest.h>

#include "mms/io/journal/journal_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

constexpr double kVoxel = 0.02;  // [m]

/// The map has one point, in a block of its own.
MapChanges map_of(int place, double voxel_size, bool whole) {
  MapChanges changes;
  changes.voxel_size = voxel_size;
  changes.whole = whole;
  changes.blocks = {{{place, 0, 0}, 1, 1}};
  changes.voxels = {{0, 1, {1, 2, 3}, {0, 0, 127}, {9, 8, 7}}};
  return changes;
}

/// Points of the map that a run leaves that was killed after two keyframes.
std::size_t points_after(Status second, const MapChanges& changes) {
  const testing::TempFolder folder;
  const auto file = folder.path() / kJournalName;
  {
    JournalWriter writer(file, {"a recording", kVoxel, 1});
    JournalFrame frame;
    frame.keyframe = true;
    frame.organised = true;
    frame.map = map_of(0, kVoxel, false);
    writer.append(frame);
    frame.stamp = Timestamp(1);
    frame.status = second;
    frame.map = changes;
    writer.append(frame);
  }
  return recover_run(file).map.size();
}

TEST(RecoveredRun, HasTheMapsOfAllSessions) {
  EXPECT_EQ(points_after(Status::kInitialized, map_of(5, kVoxel, true)), 2U);
  EXPECT_EQ(points_after(Status::kRecovered, map_of(5, kVoxel, true)), 2U)
      << "it begins where an earlier place is recognized";
  EXPECT_EQ(points_after(Status::kTracking, map_of(5, kVoxel, false)), 2U) << "the same session";
}

TEST(RecoveredRun, CoarserMapsReplaceThoseOfTheirSession) {
  EXPECT_EQ(points_after(Status::kTracking, map_of(0, 2.0 * kVoxel, true)), 1U);
}

}  // namespace
}  // namespace mms
