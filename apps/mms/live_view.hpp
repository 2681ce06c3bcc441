#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "mms/core/trajectory.hpp"
#include "mms/dataset/frame_source.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/config.hpp"
#include "run_log.hpp"
#include "viewing.hpp"

namespace mms {

/// True positions while a run goes on: the truth is put in place by the first frame that has one.
class LiveTruth {
 public:
  explicit LiveTruth(Trajectory truth);

  bool empty() const { return truth_.empty(); }

  /// True position at a frame in the frame of the estimate [m]; nothing where none is near in time.
  std::optional<Eigen::Vector3d> at(const StampedPose& estimate);

 private:
  Trajectory truth_;  // by time
  std::optional<Eigen::Isometry3d> T_world_truth_;
};

/// Shows a run while it goes on. Frames are handed over, not copied, and nothing is encoded in the
/// run's own threads.
class LiveView {
 public:
  /// @param frames  how many are to come
  /// @throws DataError when the viewer cannot be served there.
  LiveView(const ViewOptions& options, const std::string& data, const FrameSource& source,
           const SystemConfig& config, std::size_t frames);

  /// @param map  what the frame did to the map; null where nothing
  void show(Processed processed, std::shared_ptr<const MapChanges> map);

  /// All frames are in, and the run's files are in `folder`.
  void end(const std::filesystem::path& folder, const RunLog& log);

  std::string url() const { return server_->url(); }

 private:
  LiveTruth truth_;
  std::shared_ptr<Scene> scene_;
  std::unique_ptr<ViewerServer> server_;
};

/// The series of a run: milliseconds of reading and of all stages, share of dynamic points, objects
/// and, where there is truth, distance to it.
std::vector<SeriesName> run_series(bool has_truth);

}  // namespace mms
