#include "mms/run/record/recovered_run.hpp"

#include "mms/core/error.hpp"
#include "mms/io/journal/journal_reader.hpp"
#include "mms/mapping/static_map/static_map.hpp"

namespace mms {
namespace {

StaticMap empty_map(const JournalHeader& header) {
  StaticMapConfig config;
  config.voxel_size = header.voxel_size;
  config.min_observations = header.min_observations;
  return StaticMap(config);
}

/// Whether a session begins with this frame. One that begins where an earlier place is recognized
/// has no status of its own, but its first map replaces the one before. So does a map that grew out
/// of its memory, but with larger voxels.
bool begins_session(const JournalFrame& frame, const StaticMap& map) {
  if (frame.status == Status::kInitialized) return true;
  return frame.map && frame.map->whole && frame.map->voxel_size <= map.voxel_size();
}

}  // namespace

RecoveredRun recover_run(const std::filesystem::path& journal) {
  JournalReader reader(journal);
  RecoveredRun run;
  run.header = reader.header();
  StaticMap map = empty_map(run.header);
  const auto end_session = [&] {
    append(run.map, run.organised ? map.cloud() : map.cloud_with_normals());
    map = empty_map(run.header);
  };
  while (const std::optional<JournalFrame> frame = reader.next()) {
    if (map.size() > 0 && begins_session(*frame, map)) end_session();
    if (frame->map) map.apply(*frame->map);
    const bool has_evidence_again =
        !run.trajectory.empty() && run.trajectory.back().stamp == frame->stamp;
    if (has_evidence_again) continue;
    const StampedPose pose{frame->stamp, frame->T_world_sensor};
    run.trajectory.push_back(pose);
    if (frame->keyframe) run.keyframes.push_back(pose);
    run.written = frame->written;
    run.organised = frame->organised;
  }
  run.damage = reader.damage();
  if (run.trajectory.empty()) {
    throw DataError(run.damage.empty() ? journal.string() : run.damage, "has no complete frame",
                    "the run ended before its first frame was processed");
  }
  end_session();
  return run;
}

}  // namespace mms
