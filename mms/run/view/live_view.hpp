#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "mms/dataset/source/frame_source.hpp"
#include "mms/pipeline/async_pipeline.hpp"
#include "mms/pipeline/config.hpp"
#include "mms/run/record/run_log.hpp"
#include "mms/run/view/live_truth.hpp"
#include "mms/run/view/serve.hpp"

namespace mms {

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

  /// Shows what was done to the map after the last frame.
  void show_map(const MapChanges& map) { scene_->add_map(std::make_shared<const MapChanges>(map)); }

  /// All frames are in, and the run's files are in `folder`.
  void end(const std::filesystem::path& folder, const RunLog& log);

  const ViewerServer& server() const { return *server_; }

 private:
  LiveTruth truth_;
  std::shared_ptr<Scene> scene_;
  std::size_t frames_ = 0;  // shown so far
  std::unique_ptr<ViewerServer> server_;
};

}  // namespace mms
