#include "mms/dataset/source/rgbd_source.hpp"

#include <algorithm>

#include "mms/core/error.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

template <class T>
void check_size(const Image<T>& image, const CameraIntrinsics& camera, const fs::path& path) {
  if (image.width() == camera.width && image.height() == camera.height) return;
  throw DataError(path.string(), "is " + size_text(image.width(), image.height()) +
                                     " pixels, the calibration has " +
                                     size_text(camera.width, camera.height));
}

/// Depth in meters of a raw depth image, 0 for no return.
Image<float> to_metres(const Image<std::uint16_t>& raw, double scale, std::uint16_t invalid) {
  Image<float> depth(raw.width(), raw.height());
  const float units = static_cast<float>(scale);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    depth[i] = raw[i] == invalid ? 0.0F : static_cast<float>(raw[i]) / units;
  }
  return depth;
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

RgbdSource::RgbdSource(RgbdRecording recording) : recording_(std::move(recording)) {
  set_ground_truth(std::move(recording_.ground_truth));
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
  frame.calibration = recording_.calibration;
  frame.depth_offset = files.depth_offset;
  frame.color = read_color(files.color);
  check_size(frame.color, camera, files.color);
  const Image<std::uint16_t> raw = read_depth16(files.depth);
  check_size(raw, camera, files.depth);
  frame.depth = to_metres(raw, recording_.calibration->depth_scale, recording_.invalid_depth);
  if (!files.mask.empty()) {
    frame.mask = read_mask(files.mask);
    check_size(frame.mask, camera, files.mask);
  }
  return frame;
}

std::vector<std::string> RgbdSource::facts() const {
  const Calibration& calibration = *recording_.calibration;
  std::vector<std::string> lines = recording_.facts;
  lines.push_back("image: " + size_text(calibration.camera->width, calibration.camera->height) +
                  " pixels, " + format_number(calibration.depth_scale) + " depth units per meter");
  return lines;
}

}  // namespace mms
