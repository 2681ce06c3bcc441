#include "mms/dataset/source/rgbd_source.hpp"

#include <algorithm>
#include <cmath>

#include "mms/core/error.hpp"
#include "mms/dataset/source/depth_file.hpp"
#include "mms/dataset/source/image_size.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

/// The pixels of `from` that see the same points as those of `to`, nearest ones; T() beyond the
/// image. Distortion is ignored.
template <class T>
Image<T> sampled(const Image<T>& image, const CameraIntrinsics& from, const CameraIntrinsics& to) {
  Image<T> result(to.width, to.height);
  for (int y = 0; y < to.height; ++y) {
    const long v = std::lround(from.fy * (y - to.cy) / to.fy + from.cy);
    if (v < 0 || v >= image.height()) continue;
    for (int x = 0; x < to.width; ++x) {
      const long u = std::lround(from.fx * (x - to.cx) / to.fx + from.cx);
      if (u >= 0 && u < image.width()) {
        result(x, y) = image(static_cast<int>(u), static_cast<int>(v));
      }
    }
  }
  return result;
}

}  // namespace

void find_masks(RgbdRecording& recording, const SourceOptions& options) {
  const fs::path folder = options.masks.empty() ? recording.folder / "masks" : options.masks;
  if (!options.load_masks || (options.masks.empty() && !fs::is_directory(folder))) {
    recording.facts.emplace_back("masks: none");
    return;
  }
  const std::vector<std::string> names = list_folder(folder);
  std::string missing;
  std::size_t found = 0;
  for (RgbdFiles& frame : recording.frames) {
    const std::string name = frame.name + ".png";
    if (std::binary_search(names.begin(), names.end(), name)) {
      frame.mask = folder / name;
      ++found;
    } else if (missing.empty()) {
      missing = name;
    }
  }
  const std::string share =
      std::to_string(found) + " of " + std::to_string(recording.frames.size());
  recording.facts.push_back("masks: " + share + " in " + folder.string());
  if (missing.empty()) return;
  if (found == 0 && !options.masks.empty()) {
    throw DataError(folder.string(), "has no mask for any frame",
                    "masks are named as the color images, the first one " + missing);
  }
  recording.warnings.push_back(folder.string() + ": only " + share +
                               " frames have a mask, the first one missing is " + missing);
}

Image<Rgb> read_color_of(const RgbdRecording& recording, const RgbdFiles& frame) {
  return recording.video ? recording.video->read(frame.video_index) : read_color(frame.color);
}

RgbdSource::RgbdSource(RgbdRecording recording)
    : recording_(std::move(recording)),
      calibration_(registered_calibration(recording_.calibration)),
      registration_(make_registration(*recording_.calibration)) {
  set_ground_truth(std::move(recording_.ground_truth));
  set_assumed_rate(recording_.assumed_rate);
  set_map_truth(recording_.folder / "map_truth.ply");
  set_objects_truth(recording_.folder / "objects_truth.json");
  for (const std::string& warning : recording_.warnings) warn(warning);
}

bool RgbdSource::has_masks() const {
  return std::any_of(recording_.frames.begin(), recording_.frames.end(),
                     [](const RgbdFiles& files) { return !files.mask.empty(); });
}

Frame RgbdSource::read(std::size_t index) const {
  const RgbdFiles& files = recording_.frames[index];
  const CameraIntrinsics& camera = *recording_.calibration->camera;
  Frame frame;
  frame.calibration = calibration_;
  frame.depth_offset = files.depth_offset;
  const CameraIntrinsics color_camera = recording_.color_camera.value_or(camera);
  frame.color = read_color_of(recording_, files);
  check_size(frame.color, color_camera, files.color.string());
  frame.depth = read_depth(files.depth, recording_.calibration->depth_scale,
                           recording_.invalid_depth, recording_.float_depth_scale);
  check_size(frame.depth, registration_ ? registration_->depth_camera() : camera,
             files.depth.string());
  if (registration_) frame.depth = registration_->apply(frame.depth);
  if (!files.mask.empty()) {
    frame.mask = read_mask(files.mask);
    check_size(frame.mask, color_camera, files.mask.string());
  }
  if (recording_.color_camera) {
    frame.color = sampled(frame.color, color_camera, camera);
    if (!frame.mask.empty()) frame.mask = sampled(frame.mask, color_camera, camera);
  }
  return frame;
}

std::vector<std::string> RgbdSource::facts() const {
  const Calibration& calibration = *recording_.calibration;
  std::vector<std::string> lines = recording_.facts;
  lines.push_back("sensor: depth camera, " +
                  size_text(calibration.camera->width, calibration.camera->height) + " pixels");
  if (registration_) {
    const CameraIntrinsics& depth = registration_->depth_camera();
    lines.push_back("depth: " + size_text(depth.width, depth.height) +
                    " pixels, registered to the color images by the extrinsics");
  }
  lines.push_back("depth scale: " + format_number(calibration.depth_scale) + " units per meter");
  return lines;
}

}  // namespace mms
