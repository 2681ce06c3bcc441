#include "mms/dataset/source/pose_file.hpp"

#include <string>

#include "mms/core/error.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

Transform<World, Sensor> read_pose(const fs::path& path) {
  const TextTable table(path);
  const std::string where = path.string();
  return Transform<World, Sensor>(isometry_from_rows(parse_finite(table.fields(), where), where));
}

}  // namespace

void add_pose_files(RgbdRecording& recording, const std::vector<fs::path>& files) {
  std::string first;
  std::size_t skipped = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!fs::exists(files[i])) continue;
    try {
      recording.ground_truth.push_back({recording.frames[i].stamp, read_pose(files[i])});
    } catch (const Error& error) {
      if (skipped++ == 0) first = error.what();
    }
  }
  if (skipped == 0) return;
  const std::string more = skipped == 1 ? "" : " (" + std::to_string(skipped) + " such poses)";
  recording.warnings.push_back("pose skipped: " + first + more);
}

}  // namespace mms
