#include "mms/dataset/numbered/scannetpp.hpp"

#include "mms/core/error.hpp"
#include "mms/dataset/numbered/numbered_images.hpp"
#include "mms/dataset/source/calibration_choice.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/folder_names.hpp"
#include "mms/dataset/source/resized_camera.hpp"
#include "mms/io/config/camera_json.hpp"
#include "mms/io/image/picture_files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFrames = "pose_intrinsic_imu.json";

CameraIntrinsics camera_of_matrix(const Eigen::Matrix3d& m, int width, int height) {
  return {m(0, 0), m(1, 1), m(0, 2), m(1, 2), width, height, {}};
}

}  // namespace

bool is_scannetpp_layout(const std::vector<std::string>& names) {
  return has_name(names, kFrames) || has_name(names, "iphone");
}

std::unique_ptr<FrameSource> open_scannetpp(const fs::path& folder, const SourceOptions& options) {
  RgbdRecording recording;
  recording.folder = fs::is_directory(folder / "iphone") ? folder / "iphone" : folder;
  recording.facts.emplace_back("layout: ScanNet++, iPhone");
  for (const char* kind : {"rgb", "depth"}) {
    if (fs::is_directory(recording.folder / kind)) continue;
    throw DataError(recording.folder.string(),
                    std::string("is a recording of ScanNet++ without its images in ") + kind + "/",
                    "extract them with iphone/prepare_iphone_data.py of its toolbox");
  }
  const auto numbers =
      add_numbered_frames(recording, {recording.folder / "rgb", "frame_", color_endings()},
                          {recording.folder / "depth", "frame_", depth_endings()});
  const auto cameras = read_posed_cameras(recording.folder / kFrames);
  if (cameras.empty()) throw DataError((recording.folder / kFrames).string(), "has no frames");
  const Image<Rgb> color = first_color(recording);
  recording.color_camera =
      camera_of_matrix(cameras.begin()->second.matrix, color.width(), color.height());
  choose_calibration(recording, options.camera, [&] {
    const Image<float> depth = first_depth(recording);
    Calibration calibration;
    calibration.camera = resized_camera(*recording.color_camera, depth.width(), depth.height());
    recording.facts.push_back(std::string("calibration: ") + kFrames);
    return std::optional(calibration);
  });
  for (const RgbdFiles& frame : recording.frames) {
    const auto camera = cameras.find(frame.name);
    if (camera == cameras.end()) continue;
    recording.ground_truth.push_back(
        {frame.stamp, Transform<World, Sensor>(camera->second.T_world_camera)});
  }
  recording.facts.push_back(std::string("poses: ") + kFrames + ", " +
                            std::to_string(recording.ground_truth.size()) + " of " +
                            std::to_string(numbers.size()) + " frames");
  find_masks(recording, options);
  return std::make_unique<RgbdSource>(std::move(recording));
}

}  // namespace mms
