#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/core/frame.hpp"
#include "mms/dataset/source/source_options.hpp"

namespace mms {

/// Files of one LiDAR scan; those beside the scan are empty where there are none.
struct ScanFiles {
  std::filesystem::path scan;
  std::filesystem::path times;  ///< of the points
  std::filesystem::path color;
  std::filesystem::path mask;
};

/// Finds the scans *.bin of a folder, or of its velodyne/, in the order of their names.
/// @throws DataError when there are none.
std::vector<ScanFiles> find_scans(const std::filesystem::path& folder);

/// Finds what else there is of each scan, by its name: point_times/, and with a calibrated camera
/// image_2/ (.jpg, .jpeg or .png) and masks/ or the options' folder. Says in `facts` how many.
/// @throws DataError when the options' folder has a mask for none of the scans.
void find_companions(std::vector<ScanFiles>& scans, const std::filesystem::path& folder,
                     const Calibration& calibration, const SourceOptions& options,
                     std::vector<std::string>& facts);

/// The frame but for its index, stamp and name.
/// @throws FileError, DataError when a file is damaged, there are more or fewer times than points,
///         or an image is of another size than the calibration says.
Frame read_scan_frame(const ScanFiles& files,
                      const std::shared_ptr<const Calibration>& calibration);

}  // namespace mms
