#include "mms/dataset/numbered/arkit_scenes.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/pose_text.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr const char* kColor = "lowres_wide";
constexpr const char* kDepth = "lowres_depth";
constexpr const char* kIntrinsics = "lowres_wide_intrinsics";
constexpr const char* kPoses = "lowres_wide.traj";

/// The stamp in "41069021_305.377.png"; nullopt for other names.
std::optional<Timestamp> stamp_of_name(const fs::path& name) {
  const std::string stem = name.stem().string();
  const std::size_t line = stem.rfind('_');
  if (name.extension() != ".png" || line == std::string::npos) return std::nullopt;
  return parse_stamp(std::string_view(stem).substr(line + 1));
}

void add_named_frames(RgbdRecording& recording) {
  std::size_t colors = 0;
  for (const std::string& name : list_folder(recording.folder / kColor)) {
    const auto stamp = stamp_of_name(name);
    if (!stamp) continue;
    ++colors;
    const fs::path depth = recording.folder / kDepth / name;
    if (!fs::exists(depth)) continue;
    recording.frames.push_back({*stamp,
                                Duration::zero(),
                                recording.folder / kColor / name,
                                depth,
                                {},
                                fs::path(name).stem().string()});
  }
  const std::string counts = std::to_string(colors) + " color images VIDEO_STAMP.png, " +
                             std::to_string(recording.frames.size()) + " with depth";
  if (recording.frames.empty()) throw DataError(recording.folder.string(), "has " + counts);
  recording.facts.push_back("images: " + counts);
  std::stable_sort(recording.frames.begin(), recording.frames.end(),
                   [](const RgbdFiles& a, const RgbdFiles& b) { return a.stamp < b.stamp; });
}

std::optional<Calibration> read_pincam(RgbdRecording& recording) {
  for (const RgbdFiles& frame : recording.frames) {
    const fs::path file = recording.folder / kIntrinsics / (frame.name + ".pincam");
    if (!fs::exists(file)) continue;
    const TextTable table(file);
    const std::string where = file.string();
    if (table.lines().empty()) throw DataError(where, "is empty");
    const std::vector<double> n = parse_finite(table.lines()[0].fields, where);
    const auto is_side = [](double side) { return side >= 1.0 && side <= kMaxImageSide; };
    if (n.size() != 6 || !is_side(n[0]) || !is_side(n[1]))
      throw DataError(where, "is not width height fx fy cx cy");
    recording.facts.push_back("calibration: " + file.filename().string());
    Calibration calibration;
    calibration.camera = CameraIntrinsics{
        n[2], n[3], n[4], n[5], static_cast<int>(n[0]), static_cast<int>(n[1]), {}};
    return calibration;
  }
  return std::nullopt;
}

void read_poses_of_arkit(RgbdRecording& recording) {
  const fs::path file = recording.folder / kPoses;
  if (!fs::exists(file)) return;
  const TextTable table(file);
  for (const TextLine& line : table.lines()) {
    const std::string where = table.where(line);
    const auto stamp = parse_stamp(line.fields[0]);
    const std::vector<std::string_view> fields(line.fields.begin() + 1, line.fields.end());
    const std::vector<double> n = parse_finite(fields, where);
    if (!stamp || n.size() != 6) {
      throw DataError(where, "is not a pose", "expected stamp, axis times angle, translation");
    }
    const Eigen::Vector3d turn(n[0], n[1], n[2]);
    Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
    T_camera_world.translation() = Eigen::Vector3d(n[3], n[4], n[5]);
    if (turn.norm() > 0.0) {
      T_camera_world.linear() =
          Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    }
    recording.ground_truth.push_back({*stamp, Transform<World, Sensor>(T_camera_world.inverse())});
  }
  recording.facts.push_back(std::string("poses: ") + kPoses + ", " +
                            std::to_string(recording.ground_truth.size()));
}

}  // namespace

bool is_arkit_scenes_layout(const std::vector<std::string>& names) {
  return has_name(names, kColor) && has_name(names, kDepth);
}

std::unique_ptr<FrameSource> open_arkit_scenes(const fs::path& folder,
                                               const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = folder;
  recording.facts.emplace_back("layout: ARKitScenes, low resolution");
  add_named_frames(recording);
  choose_calibration(recording, options.camera, [&] { return read_pincam(recording); });
  read_poses_of_arkit(recording);
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
