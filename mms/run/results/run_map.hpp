#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "mms/core/calibration.hpp"
#include "mms/map_file/map_file.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_log.hpp"
#include "mms/run/record/run_options.hpp"

namespace mms {

/// Map files of a run: the earlier map that it starts from, and the one that it writes. That one is
/// locked for the run, and changes only when the run ends.
class RunMap {
 public:
  /// Opens the files, so that faults are found before the run.
  /// @param calibration  of the recording; may be null
  /// @throws Error for options that exclude each other, and files that cannot be read or written
  RunMap(const RunOptions& options, const Calibration* calibration, const SystemConfig& config);

  /// Gives the earlier map to the system, if there is one.
  void load(SlamSystem& system, const MapFile::WarningHandler& warn);

  /// @throws DataError for a frame of another sensor than the earlier map's
  void check(const FrameResult& frame) const;

  /// Writes the map with the run as its next session, if that was asked for.
  /// @returns whether it was written
  /// @throws FileError if it cannot be; an earlier map is as before then
  bool save(const SlamSystem& system, const RunLog& log, const MapFile::WarningHandler& warn);

 private:
  MapSession session_of(const RunLog& log, std::uint32_t number) const;

  std::filesystem::path path_;  // that is written
  std::string name_;            // of the recording
  std::string settings_;
  CameraIntrinsics camera_;
  std::unique_ptr<MapFile> earlier_;
  std::unique_ptr<MapFile> written_;  // null where nothing is
  std::optional<bool> has_scans_;     // of the earlier map
  MapUse use_ = MapUse::kExtend;
};

}  // namespace mms
