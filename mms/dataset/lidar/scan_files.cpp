#include "mms/dataset/lidar/scan_files.hpp"

#include <algorithm>
#include <set>

#include "mms/core/error.hpp"
#include "mms/dataset/source/image_size.hpp"
#include "mms/io/cloud/kitti_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/image/picture_files.hpp"
#include "mms/io/text/files.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

using Member = fs::path ScanFiles::*;

/// Sets a member of each scan with a file of its name in the folder.
/// @returns the number of files found
std::size_t find_files(std::vector<ScanFiles>& scans, const fs::path& folder,
                       const std::vector<std::string>& extensions, Member member) {
  if (!fs::is_directory(folder)) return 0;
  const std::vector<std::string> names = list_folder(folder);
  std::size_t found = 0;
  for (ScanFiles& files : scans) {
    for (const std::string& extension : extensions) {
      const std::string name = files.scan.stem().string() + extension;
      if (!std::binary_search(names.begin(), names.end(), name)) continue;
      files.*member = folder / name;
      ++found;
      break;
    }
  }
  return found;
}

void add_fact(std::vector<std::string>& facts, const std::string& what, std::size_t found,
              std::size_t count) {
  if (found == 0) return;
  facts.push_back(what + ": " + std::to_string(found) + " of " + std::to_string(count) + " scans");
}

void find_masks(std::vector<ScanFiles>& scans, const fs::path& folder, const SourceOptions& options,
                std::vector<std::string>& facts) {
  const fs::path masks = options.masks.empty() ? folder / "masks" : options.masks;
  const std::size_t found = find_files(scans, masks, {".png"}, &ScanFiles::mask);
  if (found == 0 && !options.masks.empty()) {
    throw DataError(masks.string(), "has no mask for any scan",
                    "masks are named as the scans, the first one " +
                        scans.front().scan.stem().string() + ".png");
  }
  add_fact(facts, "masks", found, scans.size());
}

}  // namespace

void find_companions(std::vector<ScanFiles>& scans, const fs::path& folder,
                     const Calibration& calibration, const SourceOptions& options,
                     std::vector<std::string>& facts) {
  add_fact(facts, "point times",
           find_files(scans, folder / "point_times", {".bin"}, &ScanFiles::times), scans.size());
  const fs::path images = folder / "image_2";
  if (!calibration.camera) {
    if (fs::is_directory(images)) {
      facts.emplace_back("images: not used, the calibration has no camera");
    }
    return;
  }
  add_fact(facts, "images", find_files(scans, images, color_endings(), &ScanFiles::color),
           scans.size());
  if (options.load_masks) find_masks(scans, folder, options, facts);
}

Frame read_scan_frame(const ScanFiles& files, const ScanFormat& format,
                      const std::shared_ptr<const Calibration>& calibration) {
  Frame frame;
  frame.calibration = calibration;
  frame.scan = read_scan(files.scan, format);
  if (!files.times.empty()) {
    frame.scan.time_offset = read_point_times(files.times);
    check_point_times(frame.scan.time_offset, files.times);
    if (frame.scan.time_offset.size() != frame.scan.points.size()) {
      throw DataError(files.times.string(),
                      "has " + std::to_string(frame.scan.time_offset.size()) + " times for " +
                          std::to_string(frame.scan.points.size()) + " points");
    }
  }
  if (!files.color.empty()) {
    frame.color = read_color(files.color);
    check_size(frame.color, *calibration->camera, files.color.string());
  }
  if (!files.mask.empty()) {
    frame.mask = read_mask(files.mask);
    check_size(frame.mask, *calibration->camera, files.mask.string());
  }
  return frame;
}

}  // namespace mms
