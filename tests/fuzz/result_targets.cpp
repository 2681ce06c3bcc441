#include <filesystem>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/run/record/recorded_run.hpp"
#include "mms/run/record/run_record.hpp"
#include "mms/run/view/recorded_scene.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace mms::testing {
namespace {

using Seeds = std::vector<std::string>;

constexpr const char* kPoses = "1.0 0 0 0 0 0 0 1\n1.1 0.5 0 0 0 0 0 1\n1.2 1 0 0 0 0 0 1\n";

RunRecord some_record() {
  RunRecord record;
  record.data = "/nowhere";
  record.voxel_size = 0.05;
  record.camera = CameraIntrinsics{
      .fx = 500.0, .fy = 500.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480};
  return record;
}

Seeds run_record_seeds() {
  RunRecord given = some_record();
  given.given = {
      .file = "camera.yaml", .intrinsics = {{500.0, 500.0, 320.0, 240.0}}, .depth_scale = 1000.0};
  given.topics.color = "/color";
  Seeds seeds;
  for (const RunRecord& record : {some_record(), given}) {
    seeds.push_back(bytes_of("run.json", [&](const auto& file) {
      write_run_record(file.parent_path(), record, RunLog({}, false, {}));
    }));
  }
  return seeds;
}

void read_run_record_bytes(std::string_view bytes) {
  read_run_record(as_file(bytes, "run.json"));
}

Seeds frame_record_seeds() {
  return {
      "stamp,index,status,dynamic_share,overruled_share,implausible_masks,session,in_map\n"
      "1.000000000,0,tracking,0.12500,0.00000,0,0,1\n"
      "1.100000000,2,initialized,0.00000,0.00000,1,1,0\n",
      "1.000000000,0,tracking,0.12500,0.00000,0,0\n",
      "1.000000000,0,tracking,0.12500,0.00000,0\n1.100000000,2,lost,0.00000,0.00000,1\n",
      "1.000000000,0,tracking,0.12500\n"};
}

void read_frame_record_bytes(std::string_view bytes) {
  read_frame_records(as_file(bytes, "frames.csv"));
}

Seeds run_table_seeds() {
  std::string times = "1.000000000";
  for (std::size_t i = 0; i < 3 + kStageCount; ++i) times += ",1.500";
  return {times + "\n",
          "stamp,earlier_stamp,outcome,inliers,overlap,contradiction,dissimilarity,sigma,"
          "tx,ty,tz,qx,qy,qz,qw\n"
          "1.200000000,1.000000000,accepted,40,0.900,0.0100,0.020,0.0100,0,0,0,0,0,0,1\n"};
}

/// The folder of a run with the bytes as one of its tables, then as the other one.
void read_run_table_bytes(std::string_view bytes) {
  const auto folder = fuzz_folder() / "run";
  std::filesystem::create_directories(folder);
  write_file(folder / "trajectory.tum", kPoses);
  std::vector<std::string> warnings;
  for (const char* name : {"timing.csv", "loops.csv"}) {
    write_file(folder / name, bytes);
    open_recorded_scene(folder, warnings);
    std::filesystem::remove(folder / name);
  }
  // Faults in a table are warnings; as the others they are errors.
  if (warnings.size() == 2) throw DataError("input", warnings.front());
}

}  // namespace

std::vector<FuzzTarget> result_targets() {
  return {{"run_record", run_record_seeds, read_run_record_bytes},
          {"frame_records", frame_record_seeds, read_frame_record_bytes},
          {"run_tables", run_table_seeds, read_run_table_bytes}};
}

}  // namespace mms::testing
