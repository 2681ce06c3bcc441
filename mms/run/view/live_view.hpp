#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/correction_feed.hpp"
#include "mms/pipeline/mapping.hpp"
#include "mms/pipeline/system_config.hpp"
#include "mms/run/record/run_log.hpp"
#include "mms/run/view/live_truth.hpp"
#include "mms/run/view/serve.hpp"

namespace mms {

/// Displays a live run. Frames are moved, not copied, and encoded outside the run's threads.
class LiveView {
 public:
  /// @param frames  number of frames to expect
  /// @throws DataError if the viewer cannot be served.
  LiveView(const ViewOptions& options, const std::string& data, const FrameSource& source,
           const SystemConfig& config, std::size_t frames);

  /// Keeps the frames so far in a temporary file in a folder; to be called before the first one.
  void keep_on_disk(const std::filesystem::path& folder) { scene_->keep_on_disk(folder); }

  /// Displays a frame. Poses and map are in the world frame of the odometry; where loops correct
  /// them, those so far are moved to agree with the present pose.
  /// @param map      changes of the map by the frame; null for none
  /// @param mapping  after the frame
  void show(Processed processed, double interval_ms, std::shared_ptr<const MapChanges> map,
            const Mapping& mapping);

  /// Displays changes of the map after the last frame.
  void show_map(const MapChanges& map) { scene_->add_map(std::make_shared<const MapChanges>(map)); }

  /// Ends the live run; the run's files are in `folder`. With loops, their poses and map are shown.
  void end(const std::filesystem::path& folder, const RunLog& log);

  const ViewerServer& server() const { return *server_; }

 private:
  using Clock = std::chrono::steady_clock;

  void show_corrected(const FrameResult& result, const Mapping& mapping);
  void show_aligned_truth(const RunLog& log);

  LiveTruth truth_;
  std::shared_ptr<Scene> scene_;
  std::vector<std::uint32_t> sessions_;  // of the frames displayed so far
  MapCorrection shown_;                  // of the first `corrected_` frames
  std::size_t corrected_ = 0;
  Clock::time_point next_correction_;
  std::unique_ptr<ViewerServer> server_;
};

}  // namespace mms
