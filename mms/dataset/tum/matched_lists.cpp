#include "mms/dataset/tum/matched_lists.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "mms/core/error.hpp"
#include "mms/dataset/source/frame_association.hpp"

namespace mms {
namespace {

constexpr Duration kMaxDifference = std::chrono::milliseconds(20);

std::vector<Timestamp> stamps_of(const std::vector<ListedImage>& images) {
  std::vector<Timestamp> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp);
  return stamps;
}

}  // namespace

void add_frame(RgbdRecording& recording, const ListedImage& color, const ListedImage& depth) {
  recording.frames.push_back({color.stamp,
                              depth.stamp - color.stamp,
                              color.path,
                              depth.path,
                              {},
                              color.path.stem().string()});
}

void add_matched_frames(RgbdRecording& recording, const std::vector<ListedImage>& color,
                        const std::vector<ListedImage>& depth) {
  for (const auto& [i, j] : associate(stamps_of(color), stamps_of(depth), kMaxDifference)) {
    add_frame(recording, color[i], depth[j]);
  }
  const std::string counts =
      std::to_string(color.size()) + " color and " + std::to_string(depth.size()) + " depth images";
  if (recording.frames.empty()) {
    throw DataError(
        recording.folder.string(), "of " + counts + ", no two match within 0.02 s",
        "the lists begin at " + color[0].stamp.to_string() + " and " + depth[0].stamp.to_string());
  }
  recording.facts.push_back("images: " + counts + ", " + std::to_string(recording.frames.size()) +
                            " matched within 0.02 s, " +
                            std::to_string(color.size() - recording.frames.size()) +
                            " color images unmatched");
  sort_by_stamp(recording);
}

void sort_by_stamp(RgbdRecording& recording) {
  const auto earlier = [](const RgbdFiles& a, const RgbdFiles& b) { return a.stamp < b.stamp; };
  if (std::is_sorted(recording.frames.begin(), recording.frames.end(), earlier)) return;
  std::stable_sort(recording.frames.begin(), recording.frames.end(), earlier);
  recording.facts.emplace_back("stamps: not in order in the list, sorted");
}

}  // namespace mms
