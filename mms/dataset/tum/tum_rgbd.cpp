#include "mms/dataset/tum/tum_rgbd.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "mms/core/error.hpp"
#include "mms/dataset/source/assumed_stamp.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/image_list.hpp"
#include "mms/dataset/source/rgbd_source.hpp"
#include "mms/dataset/tum/matched_lists.hpp"
#include "mms/dataset/tum/tum_calibration.hpp"
#include "mms/dataset/tum/unlisted_images.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/results/trajectory_io.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// Lists of the color images and of the depth images registered to them.
struct ListNames {
  const char* color;
  const char* depth;
};
constexpr ListNames kListNames[] = {{"rgb.txt", "depth.txt"},
                                    {"color.txt", "aligned_depth.txt"}};  // OpenLORIS

/// Empty if there is none.
fs::path find_pairs(const fs::path& folder) {
  for (const char* name : kPairNames) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return {};
}

void read_pairs(RgbdRecording& recording, const fs::path& file) {
  for (const ListedPair& pair : read_associations(file, recording.warnings)) {
    add_frame(recording, pair.color, pair.depth);
  }
  recording.facts.push_back("images: " + std::to_string(recording.frames.size()) + " pairs in " +
                            file.filename().string());
  sort_by_stamp(recording);
}

void match_lists(RgbdRecording& recording, const ListNames& names) {
  const auto color = read_image_list(recording.folder / names.color, recording.warnings);
  const auto depth = read_image_list(recording.folder / names.depth, recording.warnings);
  add_matched_frames(recording, color, depth);
}

/// @returns the list of the color images or pairs; empty if there is none
fs::path read_lists(RgbdRecording& recording) {
  for (const ListNames& names : kListNames) {
    if (!fs::exists(recording.folder / names.color)) continue;
    if (!fs::exists(recording.folder / names.depth)) continue;
    match_lists(recording, names);
    return recording.folder / names.color;
  }
  const fs::path pairs = find_pairs(recording.folder);
  if (!pairs.empty()) {
    read_pairs(recording, pairs);
    return pairs;
  }
  const bool color = fs::exists(recording.folder / "rgb.txt");
  const bool depth = fs::exists(recording.folder / "depth.txt");
  if (!color && !depth) {
    add_unlisted_frames(recording);
    return {};
  }
  throw DataError(recording.folder.string(),
                  std::string("is a TUM-layout sequence, but ") +
                      (color ? "depth.txt" : "rgb.txt") + " is missing",
                  "expected rgb.txt and depth.txt, or associations.txt");
}

/// The calibration of data sets in this layout.
std::optional<Calibration> known_calibration(RgbdRecording& recording,
                                             const std::optional<fs::path>& icl_truth) {
  const fs::path eth3d = recording.folder / "calibration.txt";
  if (fs::exists(eth3d)) {
    recording.facts.emplace_back("calibration: calibration.txt (ETH3D)");
    return read_eth3d_calibration(eth3d, first_color(recording));
  }
  const fs::path openloris = recording.folder / "sensors.yaml";
  if (fs::exists(openloris)) {
    recording.facts.emplace_back(
        "calibration: sensors.yaml (OpenLORIS), 1000 depth units per meter");
    return read_any_calibration(openloris).calibration;
  }
  if (icl_truth) {
    recording.facts.emplace_back("calibration: default of ICL-NUIM");
    return icl_nuim_calibration();
  }
  auto calibration = default_calibration(recording.folder);
  if (calibration) recording.facts.emplace_back("calibration: default of the folder name");
  return calibration;
}

/// Whether a stamp may be the number of an image: a whole number of seconds, long before 2001.
bool may_be_number(Timestamp stamp) {
  constexpr std::int64_t kOne = 1'000'000'000;  // [ns]
  const std::int64_t number = stamp.nanoseconds() / kOne;
  return number >= 0 && number < kMaxImageNumber && stamp.nanoseconds() % kOne == 0;
}

/// Whether the stamps are numbers of images, which mostly follow each other, as 0, 1, 2.
bool are_image_numbers(const std::vector<RgbdFiles>& frames) {
  constexpr std::size_t kMinNumbered = 5;  // less prove nothing
  if (frames.size() < kMinNumbered) return false;
  std::size_t following = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!may_be_number(frames[i].stamp)) return false;
    if (i > 0 && frames[i].stamp - frames[i - 1].stamp == std::chrono::seconds(1)) ++following;
  }
  return 2 * following >= frames.size();
}

/// Converts stamps that are image numbers, as those of ICL-NUIM, to stamps at a rate.
void count_images_at(RgbdRecording& recording, const AssumedRate& rate) {
  const auto stamp_of = [&](Timestamp number) { return Timestamp(number.nanoseconds() / rate.hz); };
  for (RgbdFiles& frame : recording.frames) {
    frame.stamp = stamp_of(frame.stamp);
    frame.depth_offset = Duration::zero();
  }
  const bool truth = std::all_of(recording.ground_truth.begin(), recording.ground_truth.end(),
                                 [](const StampedPose& pose) { return may_be_number(pose.stamp); });
  if (truth) {
    for (StampedPose& pose : recording.ground_truth) pose.stamp = stamp_of(pose.stamp);
  }
  recording.assumed_rate = rate;
}

/// Ground truth of ICL-NUIM, as livingRoom0.gt.freiburg.
std::optional<fs::path> find_icl_truth(const fs::path& folder) {
  for (const std::string& name : list_folder(folder)) {
    if (name.ends_with(".gt.freiburg")) return folder / name;
  }
  return std::nullopt;
}

/// Converts left-handed poses of a camera whose y axis is up to a camera whose y axis is down.
Trajectory mirrored(Trajectory trajectory) {
  const Eigen::DiagonalMatrix<double, 3> mirror(1.0, -1.0, 1.0);
  for (StampedPose& pose : trajectory) {
    Eigen::Isometry3d T = pose.T_world_sensor.isometry();
    T.linear() = mirror * T.linear() * mirror;
    T.translation() = mirror * T.translation();
    pose.T_world_sensor = Transform<World, Sensor>(T);
  }
  return trajectory;
}

}  // namespace

bool is_tum_rgbd_layout(const std::vector<std::string>& names) {
  const bool has_pairs = std::any_of(std::begin(kPairNames), std::end(kPairNames),
                                     [&](const char* list) { return has_name(names, list); });
  return has_name(names, "rgb.txt") || has_name(names, "depth.txt") || has_pairs ||
         (has_name(names, "color.txt") && has_name(names, "aligned_depth.txt")) ||
         (has_name(names, "rgb") && has_name(names, "depth"));
}

std::unique_ptr<FrameSource> open_tum_rgbd(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: TUM RGB-D");
  const fs::path list = read_lists(recording);
  const std::optional<fs::path> icl_truth = find_icl_truth(folder);
  choose_calibration(recording, options.camera,
                     [&] { return known_calibration(recording, icl_truth); });
  sample_colors_of_arkit(recording);
  find_masks(recording, options);
  const fs::path truth = folder / "groundtruth.txt";
  if (fs::exists(truth)) {
    recording.ground_truth = read_trajectory_tum(truth);
  } else if (icl_truth) {
    recording.ground_truth = mirrored(read_trajectory_tum(*icl_truth));
    count_images_at(recording, kDataSetRate);
    recording.facts.push_back("ground truth: " + icl_truth->filename().string() +
                              ", mirrored since its camera's y axis is up");
  }
  const bool numbers = !list.empty() && has_whole_stamps(list);
  if (numbers && !recording.assumed_rate && are_image_numbers(recording.frames)) {
    count_images_at(recording, kUnknownRate);
    recording.facts.emplace_back("numbers: the lists have those of the images in place of stamps");
  }
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
