#include "mms/dataset/tum/tum_rgbd.hpp"

#include <algorithm>
#include <chrono>

#include "mms/core/error.hpp"
#include "mms/dataset/source/frame_association.hpp"
#include "mms/dataset/source/image_list.hpp"
#include "mms/dataset/source/rgbd_source.hpp"
#include "mms/dataset/tum/tum_calibration.hpp"
#include "mms/io/config/calibration_io.hpp"
#include "mms/io/results/trajectory_io.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr Duration kMaxDifference = std::chrono::milliseconds(20);

void add_frame(RgbdRecording& recording, const ListedImage& color, const ListedImage& depth) {
  recording.frames.push_back({color.stamp,
                              depth.stamp - color.stamp,
                              color.path,
                              depth.path,
                              {},
                              color.path.stem().string()});
}

std::vector<Timestamp> stamps_of(const std::vector<ListedImage>& images) {
  std::vector<Timestamp> stamps;
  for (const ListedImage& image : images) stamps.push_back(image.stamp);
  return stamps;
}

void match_lists(RgbdRecording& recording) {
  const auto color = read_image_list(recording.folder / "rgb.txt", recording.warnings);
  const auto depth = read_image_list(recording.folder / "depth.txt", recording.warnings);
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
}

void read_lists(RgbdRecording& recording) {
  const bool color = fs::exists(recording.folder / "rgb.txt");
  const bool depth = fs::exists(recording.folder / "depth.txt");
  const fs::path associations = recording.folder / "associations.txt";
  if (color && depth) {
    match_lists(recording);
  } else if (fs::exists(associations)) {
    for (const ListedPair& pair : read_associations(associations, recording.warnings)) {
      add_frame(recording, pair.color, pair.depth);
    }
    recording.facts.push_back("images: " + std::to_string(recording.frames.size()) +
                              " pairs in associations.txt");
  } else {
    const std::string missing = !color && !depth ? "rgb.txt and depth.txt are"
                                : color          ? "depth.txt is"
                                                 : "rgb.txt is";
    throw DataError(recording.folder.string(),
                    "is a TUM-layout sequence, but " + missing + " missing",
                    "expected rgb.txt and depth.txt, or associations.txt");
  }
}

void read_calibration_of(RgbdRecording& recording) {
  const fs::path file = recording.folder / "calibration.yaml";
  std::optional<Calibration> calibration;
  if (fs::exists(file)) {
    calibration = read_calibration(file);
    recording.facts.emplace_back("calibration: calibration.yaml");
  } else {
    calibration = tum_default_calibration(recording.folder);
    recording.facts.emplace_back("calibration: TUM default of the folder name");
  }
  if (!calibration || !calibration->camera) {
    throw DataError(recording.folder.string(), "has no camera calibration",
                    "add calibration.yaml with fx, fy, cx, cy, width, height in pixels and "
                    "depth_scale in depth units per meter");
  }
  recording.calibration = std::make_shared<const Calibration>(*calibration);
}

}  // namespace

bool is_tum_rgbd_layout(const std::vector<std::string>& names) {
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  return has("rgb.txt") || has("depth.txt") || has("associations.txt") ||
         (has("rgb") && has("depth"));
}

std::unique_ptr<FrameSource> open_tum_rgbd(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: TUM RGB-D");
  read_lists(recording);
  read_calibration_of(recording);
  find_masks(recording, options);
  const fs::path truth = folder / "groundtruth.txt";
  if (fs::exists(truth)) recording.ground_truth = read_trajectory_tum(truth);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
