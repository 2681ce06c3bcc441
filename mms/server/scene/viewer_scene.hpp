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

  /// Changes a frame, given with its index.
  using ChangeFrame = std::function<void(std::size_t index, SceneFrame& frame)>;

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

  /// Changes all frames, one by one, and the map if one is given. To be called in the adding
  /// thread.
  /// @throws FileError if the frames cannot be read; they stay as they are
  void change(const ChangeFrame& change, std::shared_ptr<const MapChanges> map = nullptr);

  /// Shows loops, with the next `change` or the end.
  void set_loops(std::vector<SceneLoop> loops);

  /// Sets the sensor's properties, known from the first frame; called before that frame is added.
  void set_sensor(const std::optional<CameraIntrinsics>& camera, const Eigen::Vector3d& up);

  /// Keeps the frames in a temporary file instead of in memory; called before the first one.
  void keep_on_disk(const std::filesystem::path& folder);

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

  /// A frame. @throws FileError if it cannot be read; DataError if there is none
  SceneFrame frame(std::size_t index) const;

  /// Calls a function with the frames in [first, last), one by one, fewer if not available.
  /// @throws FileError if they cannot be read
  void for_each_frame(std::size_t first, std::size_t last,
                      const std::function<void(const SceneFrame&)>& use) const;

  /// Stamps of all frames.
  std::vector<Timestamp> stamps() const;

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
    std::vector<SceneFrame> frames;
    std::shared_ptr<const SensorView> view;
    Changes changes;
  };

  std::vector<SceneFrame> read_frames(std::size_t first, std::size_t last) const;
  void apply_pending();
  void apply_map_changes();

  SceneInfo info_;
  ViewLoader loader_;
  std::filesystem::path disk_;  // folder for frames; empty: memory
  Pending pending_;             // of the adding thread
  std::atomic<std::size_t> size_ = 0;
  std::atomic<bool> ended_ = false;
  std::atomic<std::uint64_t> edition_ = 0;

  mutable std::mutex mutex_;  // guards what follows; held briefly
  std::unique_ptr<DiskLog<SceneFrame>> frames_;
  std::vector<Timestamp> stamps_;
  std::shared_ptr<const SensorView> newest_;
  Changes changes_;
  std::filesystem::path folder_;  // with the run's files
  std::vector<SceneLoop> loops_;

  std::mutex map_mutex_;  // never locked by the run
  MapChunks map_;
};

}  // namespace mms
