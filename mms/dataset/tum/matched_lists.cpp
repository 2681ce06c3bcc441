#include "mms/dataset/tum/matched_lists.hpp"

#include <algorithm>
#include <chrono>
#include <string>

#include "mms/core/error.hpp"
#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/dataset/source/frame_association.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr Duration kMaxDifference = std::chrono::milliseconds(20);

/// [Hz]: rate above which stamps are no times of images.
/// Source: no depth camera is that fast; time steps that a script wrote as stamps are.
constexpr double kMaxRate = 1000.0;

/// [-]: frames from which on the rate is judged. Source: initial choice.
constexpr std::size_t kMinFrames = 5;

std::vector<Timestamp> stamps_of(const std::vector<ListedImage>& images) {
  std::vector<Timestamp> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp);
  return stamps;
}

/// Stamps of images without times, at the assumed rate.
void count_frames(RgbdRecording& recording) {
  std::int64_t number = 0;
  for (RgbdFiles& frame : recording.frames) {
    frame.stamp = assumed_stamp(number++, kUnknownRate);
    frame.depth_offset = Duration::zero();
  }
  recording.assumed_rate = kUnknownRate;
}

/// The time from the earliest to the latest frame.
Duration span_of(const std::vector<RgbdFiles>& frames) {
  const auto earlier = [](const RgbdFiles& a, const RgbdFiles& b) { return a.stamp < b.stamp; };
  const auto [first, last] = std::minmax_element(frames.begin(), frames.end(), earlier);
  return last->stamp - first->stamp;
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
  const double count = static_cast<double>(recording.frames.size());
  if (recording.frames.size() >= kMinFrames &&
      count > kMaxRate * to_seconds(span_of(recording.frames))) {
    recording.warnings.push_back("stamps: " + std::to_string(recording.frames.size()) +
                                 " images within " +
                                 format_number(to_seconds(span_of(recording.frames))) +
                                 " s; they are no times, so the order of the list counts");
    return count_frames(recording);
  }
  const auto earlier = [](const RgbdFiles& a, const RgbdFiles& b) { return a.stamp < b.stamp; };
  if (std::is_sorted(recording.frames.begin(), recording.frames.end(), earlier)) return;
  std::stable_sort(recording.frames.begin(), recording.frames.end(), earlier);
  recording.facts.emplace_back("stamps: not in order in the list, sorted");
}

}  // namespace mms
