#include "mms/dataset/source/calibration_choice.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/dataset/source/first_image.hpp"
#include "mms/dataset/source/resized_camera.hpp"
#include "mms/io/config/calibration_formats.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// The file of the options or of the folder; nullopt for none.
std::optional<Calibration> read_file_of(RgbdRecording& recording, const CameraOptions& options) {
  const fs::path own = recording.folder / "calibration.yaml";
  if (options.file.empty() && !fs::exists(own)) return std::nullopt;
  const fs::path& file = options.file.empty() ? own : options.file;
  const FormattedCalibration read = read_any_calibration(file);
  const Calibration& calibration = read.calibration;
  if (!calibration.camera && !options.intrinsics) {
    throw DataError(file.string(), "has no camera", "add fx fy cx cy width height depth_scale");
  }
  recording.facts.push_back(
      "calibration: " + (options.file.empty() ? own.filename() : file).string() +
      (read.format == "MMS-SLAM" ? "" : " (" + read.format + ")"));
  if (read.assumed_depth_scale && !options.depth_scale) {
    recording.facts.emplace_back("depth scale: none, 1000 units per meter assumed");
  }
  return calibration;
}

/// Whether a depth image has the size of those of ARKit, upright or not.
bool is_of_arkit(const Image<float>& depth) {
  constexpr int kLongSide = 256;   // [px]
  constexpr int kShortSide = 192;  // [px]
  return std::max(depth.width(), depth.height()) == kLongSide &&
         std::min(depth.width(), depth.height()) == kShortSide;
}

template <class T>
bool is_camera_of(const CameraIntrinsics& camera, const Image<T>& image) {
  return camera.width == image.width() && camera.height == image.height();
}

CameraIntrinsics camera_of(const std::array<double, 4>& k, const RgbdRecording& recording) {
  const Image<float> first = first_depth(recording);
  return {k[0], k[1], k[2], k[3], first.width(), first.height(), {}};
}

}  // namespace

void choose_calibration(RgbdRecording& recording, const CameraOptions& options,
                        const std::function<std::optional<Calibration>()>& of_layout) {
  std::optional<Calibration> calibration = read_file_of(recording, options);
  if (!calibration) calibration = of_layout();
  if (options.intrinsics) {
    if (!calibration) calibration.emplace();
    calibration->camera = camera_of(*options.intrinsics, recording);
    recording.facts.emplace_back("intrinsics: given, without distortion");
  }
  if (!calibration || !calibration->camera) {
    throw DataError(recording.folder.string(), "has no camera calibration",
                    "add calibration.yaml with fx, fy, cx, cy, width, height in pixels and "
                    "depth_scale in depth units per meter, or give --calibration, or --intrinsics "
                    "and --depth-scale");
  }
  check_camera(*calibration->camera, recording.folder.string() + ": camera");
  if (options.depth_scale) {
    calibration->depth_scale = *options.depth_scale;
    recording.float_depth_scale = *options.depth_scale;
    recording.facts.push_back("depth scale: given, " + format_number(*options.depth_scale));
  }
  recording.calibration = std::make_shared<const Calibration>(*calibration);
}

void sample_colors_of_arkit(RgbdRecording& recording) {
  if (recording.color_camera || recording.calibration->depth_camera) return;
  try {
    const Image<float> depth = first_depth(recording);
    if (!is_of_arkit(depth)) return;
    const Image<Rgb> color = first_color(recording);
    Calibration calibration = *recording.calibration;
    CameraIntrinsics& camera = *calibration.camera;
    const bool larger = color.width() > depth.width();
    const bool same_view = color.width() * depth.height() == color.height() * depth.width();
    if (!larger || !same_view || !(is_camera_of(camera, color) || is_camera_of(camera, depth))) {
      return;
    }
    recording.color_camera = resized_camera(camera, color.width(), color.height());
    camera = resized_camera(camera, depth.width(), depth.height());
    recording.calibration = std::make_shared<const Calibration>(calibration);
    recording.facts.emplace_back("colors: sampled for the depth images of ARKit");
  } catch (const Error&) {  // frames that cannot be read are skipped with a warning
  }
}

void reject_image_options(const fs::path& recording, const CameraOptions& options) {
  if (!options.intrinsics && !options.depth_scale) return;
  throw DataError(recording.string(), "is no folder of color and depth images",
                  "--intrinsics and --depth-scale are for those; use --calibration");
}

}  // namespace mms
