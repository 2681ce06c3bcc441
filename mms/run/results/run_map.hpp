#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/calibration.hpp"
#include "mms/map_file/map_file.hpp"
#include "mms/pipeline/slam_system.hpp"
#include "mms/pipeline/system_config.hpp"

namespace mms {

/// Map files of a run, by the options of `mms run`.
struct MapFileOptions {
  std::filesystem::path map{};       ///< earlier map to start from; empty: none
  std::filesystem::path save_map{};  ///< where the map is written; empty: in `map`, if any
  bool localize = false;             ///< changes no map
  bool overwrite = false;            ///< replaces a map at `save_map`
  std::string recording{};           ///< its name in the map
};

/// Checks options of map files before the files are opened.
/// @throws Error for those that exclude each other, and a map to be written that exists
void check_map_options(const MapFileOptions& options, const SystemConfig& config);

/// Map files of a run: the earlier map that it starts from, and the one that it writes. That one is
/// locked for the run, and changes only when the run ends.
class RunMap {
 public:
  /// Opens the files, so that faults are found before the run.
  /// @throws Error for options that exclude each other, and files that cannot be read or written
  RunMap(const MapFileOptions& options, const SystemConfig& config);

  /// Replaces the settings that the map keeps, where the first frame has changed some.
  void set_settings(const SystemConfig& config);

  /// Gives the earlier map to the system, if there is one. Before the first frame.
  /// @param calibration  of the recording; may be null
  void load(SlamSystem& system, const Calibration* calibration,
            const MapFile::WarningHandler& warn);

  /// Counts a frame.
  /// @throws DataError where it is of another sensor than the earlier map's
  void add(const FrameResult& frame);

  /// Writes the map with the run as its next session, if that was asked for.
  /// @returns whether it was written
  /// @throws FileError if it cannot be; an earlier map is as before then
  bool save(const SlamSystem& system, const MapFile::WarningHandler& warn);

 private:
  void check_sensor(const FrameResult& frame) const;

  std::filesystem::path path_;        // that is written
  MapSession session_;                // what those of the run have in common
  std::vector<MapSession> sessions_;  // of the run
  CameraIntrinsics camera_;
  std::unique_ptr<MapFile> earlier_;
  std::unique_ptr<MapFile> written_;  // null where nothing is
  std::optional<bool> has_scans_;     // of the earlier map
  MapUse use_ = MapUse::kExtend;
};

}  // namespace mms
