#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/dataset/lidar/scan_format.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Files of one LiDAR scan; optional ones are empty if missing.
struct ScanFiles {
  std::filesystem::path scan;
  std::filesystem::path times;  ///< of the points
  std::filesystem::path color;
  std::filesystem::path mask;
};

/// Finds the optional files of each scan by name: point_times/, and with a calibrated camera
/// image_2/ (.jpg, .jpeg or .png) and masks/ or the options' folder. Adds their numbers to `facts`.
/// @throws DataError if the options' folder has no mask for any scan.
void find_companions(std::vector<ScanFiles>& scans, const std::filesystem::path& folder,
                     const Calibration& calibration, const SourceOptions& options,
                     std::vector<std::string>& facts);

/// The frame without index, stamp and name.
/// @throws FileError, DataError if a file is damaged, the number of times is not that of the
/// points, or an image has a size other than the calibration's.
Frame read_scan_frame(const ScanFiles& files, const ScanFormat& format,
                      const std::shared_ptr<const Calibration>& calibration);

}  // namespace mms
