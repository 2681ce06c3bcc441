#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "mms/server/scene/map_chunks.hpp"
#include "mms/server/scene/scene_data.hpp"

namespace mms {

/// Visible state of a run, live or finished. The run adds to it in one thread; viewers read it in
/// others. Adding never blocks: additions during a read are stored and applied later.
class Scene {
 public:
  /// Returns the sensor data of a frame of a finished run, null if unavailable. Called in a server
  /// thread, one call at a time; may be slow.
  using ViewLoader = std::function<std::shared_ptr<const SensorView>(std::size_t frame)>;

  /// @param min_observations  observations that a voxel of the map needs to be visible
  explicit Scene(SceneInfo info, int min_observations = 1);

  /// Adds a frame.
  /// @param view  replaces the previous one; may be null
  /// @param map  changes of the map by the frame; null for none
  void add(SceneFrame frame, std::shared_ptr<const SensorView> view,
           std::shared_ptr<const MapChanges> map);

  /// Adds to the map only, together with the next frame or the end.
  void add_map(std::shared_ptr<const MapChanges> map) {
    pending_.changes.push_back(std::move(map));
  }

  /// Marks the run as finished.
  /// @param folder  with the run's files
  void end(const std::filesystem::path& folder);

  /// Replaces all frames and the map by those that loops corrected.
  /// @param frames  as many as there are
  void replace(SceneFrames frames, MapChanges map);

  /// All frames that were added; to be called in the adding thread.
  SceneFrames added() const;

  /// Shows loops, with the next `replace` or the end.
  void set_loops(std::vector<SceneLoop> loops);

  /// Replaces the ground-truth positions, one per frame.
  void replace_truth(const std::vector<std::optional<Eigen::Vector3d>>& truth);

  /// Sets the sensor's properties, known from the first frame; called before that frame is added.
  void set_sensor(const std::optional<CameraIntrinsics>& camera, const Eigen::Vector3d& up);

  /// To be called before viewers connect.
  void set_loader(ViewLoader loader) { loader_ = std::move(loader); }

  /// Without sensor before the first frame.
  const SceneInfo& info() const { return info_; }
  std::size_t size() const { return size_; }
  bool ended() const { return ended_; }

  /// Incremented when earlier frames change.
  std::uint64_t edition() const { return edition_; }

  /// Folder of the run's files; empty during the run.
  std::filesystem::path folder() const;

  /// Frames in [first, last), fewer if not available.
  SceneFrames frames(std::size_t first, std::size_t last) const;

  /// Sensor data of a frame, or of the newest; null if unavailable.
  std::shared_ptr<const SensorView> view(std::optional<std::size_t> frame) const;

  std::vector<SceneLoop> loops() const;

  /// The present map; first applies all pending changes.
  template <class Read>
  auto read_map(const Read& read) {
    const std::scoped_lock lock(map_mutex_);
    apply_map_changes();
    return read(static_cast<const MapChunks&>(map_));
  }

 private:
  using Changes = std::vector<std::shared_ptr<const MapChanges>>;
  struct Pending {
    SceneFrames frames;
    std::shared_ptr<const SensorView> view;
    Changes changes;
  };

  void apply_pending();
  void apply_map_changes();

  SceneInfo info_;
  ViewLoader loader_;
  Pending pending_;  // of the adding thread
  std::atomic<std::size_t> size_ = 0;
  std::atomic<bool> ended_ = false;
  std::atomic<std::uint64_t> edition_ = 0;

  mutable std::mutex mutex_;  // guards what follows; held briefly
  SceneFrames frames_;
  std::shared_ptr<const SensorView> newest_;
  Changes changes_;
  std::filesystem::path folder_;
  std::vector<SceneLoop> loops_;

  std::mutex map_mutex_;  // never locked by the run
  MapChunks map_;
};

}  // namespace mms
