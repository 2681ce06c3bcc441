#include "mms/dataset/tum/unlisted_images.hpp"

#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/tum/matched_lists.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// The images whose names are stamps in seconds, as 1305031102.175304.png.
std::vector<ListedImage> images_with_stamps(const fs::path& folder,
                                            const std::vector<std::string>& endings) {
  std::vector<ListedImage> images;
  for (const std::string& name : list_folder(folder)) {
    for (const std::string& ending : endings) {
      if (!name.ends_with(ending)) continue;
      const std::string stem = name.substr(0, name.size() - ending.size());
      const auto stamp = stem.find('.') == std::string::npos ? std::nullopt : parse_stamp(stem);
      if (stamp) images.push_back({*stamp, folder / name});
    }
  }
  return images;
}

}  // namespace

void add_unlisted_frames(RgbdRecording& recording) {
  const fs::path color = recording.folder / "rgb";
  const fs::path depth = recording.folder / "depth";
  const auto colors = images_with_stamps(color, color_endings());
  const auto depths = images_with_stamps(depth, depth_endings());
  if (!colors.empty() && !depths.empty()) {
    add_matched_frames(recording, colors, depths);
    recording.facts.emplace_back("stamps: names of the images");
    return;
  }
  const ImageSeries color_series = find_series(color, color_endings());
  const ImageSeries depth_series = find_series(depth, depth_endings());
  if (find_numbered(color_series).empty() || find_numbered(depth_series).empty()) {
    throw DataError(recording.folder.string(),
                    "is a TUM-layout sequence, but rgb.txt and depth.txt are missing",
                    "expected these lists, associations.txt, or images named by numbers or stamps");
  }
  add_numbered_frames(recording, color_series, depth_series, kUnknownRate);
}

}  // namespace mms
