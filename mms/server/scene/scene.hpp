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

/// What there is to see of a run, live or finished. The run adds to it in one thread, and viewers
/// read it in others. Adding never waits: while a viewer reads, which is for moments, what is added
/// is kept aside until the next time.
class Scene {
 public:
  /// Gives what the sensor saw at a frame of a finished run, null where that is not to be had. Runs
  /// in a thread of the server, one call at a time, and may take its time.
  using ViewLoader = std::function<std::shared_ptr<const SensorView>(std::size_t frame)>;

  /// @param min_observations  views that have to see a voxel of the map before it is shown
  explicit Scene(SceneInfo info, int min_observations = 1);

  /// Adds a frame. @param view  replaces that of the frame before; may be null
  /// @param map  what the frame did to the map; null where it did nothing
  void add(SceneFrame frame, std::shared_ptr<const SensorView> view,
           std::shared_ptr<const MapChanges> map);

  /// Adds to the map alone, together with the next frame or the end.
  void add_map(std::shared_ptr<const MapChanges> map) {
    pending_.changes.push_back(std::move(map));
  }

  /// No frame comes any more. @param folder  where the run's files are
  void end(const std::filesystem::path& folder);

  /// Puts other true positions in place, one a frame.
  void replace_truth(const std::vector<std::optional<Eigen::Vector3d>>& truth);

  /// What the first frame tells of the sensor. Called before it is added, if at all.
  void set_sensor(const std::optional<CameraIntrinsics>& camera, const Eigen::Vector3d& up);

  /// Called before viewers are there.
  void set_loader(ViewLoader loader) { loader_ = std::move(loader); }

  /// Without the sensor until there is a frame.
  const SceneInfo& info() const { return info_; }
  std::size_t size() const { return size_; }
  bool ended() const { return ended_; }

  /// Grows when frames already given have changed.
  std::uint64_t edition() const { return edition_; }

  /// Folder of the run's files; empty while the run goes on.
  std::filesystem::path folder() const;

  /// Frames from `first` to before `last`, fewer where there are fewer.
  SceneFrames frames(std::size_t first, std::size_t last) const;

  /// What the sensor saw at a frame, or at the newest; null where that is not to be had.
  std::shared_ptr<const SensorView> view(std::optional<std::size_t> frame) const;

  /// The map as it is now; takes over what was added to it since the last call.
  template <class Read>
  auto read_map(const Read& read) {
    const std::scoped_lock lock(map_mutex_);
    take_over_map();
    return read(static_cast<const MapChunks&>(map_));
  }

 private:
  using Changes = std::vector<std::shared_ptr<const MapChanges>>;
  struct Pending {
    SceneFrames frames;
    std::shared_ptr<const SensorView> view;
    Changes changes;
  };

  void take_over_pending();
  void take_over_map();

  SceneInfo info_;
  ViewLoader loader_;
  Pending pending_;  // of the thread that adds
  std::atomic<std::size_t> size_ = 0;
  std::atomic<bool> ended_ = false;
  std::atomic<std::uint64_t> edition_ = 0;

  mutable std::mutex mutex_;  // of what follows; held for moments only
  SceneFrames frames_;
  std::shared_ptr<const SensorView> newest_;
  Changes changes_;
  std::filesystem::path folder_;

  std::mutex map_mutex_;  // the run never takes it
  MapChunks map_;
};

}  // namespace mms
