#include "mms/server/scene/viewer_scene.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mms {

Scene::Scene(SceneInfo info, int min_observations)
    : info_(std::move(info)), map_(min_observations) {}

void Scene::set_sensor(const std::optional<CameraIntrinsics>& camera, const Eigen::Vector3d& up) {
  info_.camera = camera;
  info_.up = up;
}

void Scene::add(SceneFrame frame, std::shared_ptr<const SensorView> view,
                std::shared_ptr<const MapChanges> map) {
  pending_.frames.push_back(std::make_shared<const SceneFrame>(std::move(frame)));
  pending_.view = std::move(view);
  if (map) pending_.changes.push_back(std::move(map));
  const std::unique_lock lock(mutex_, std::try_to_lock);
  // Does not wait for a reader, which may have low priority.
  if (lock.owns_lock()) apply_pending();
}

void Scene::apply_pending() {
  frames_.insert(frames_.end(), pending_.frames.begin(), pending_.frames.end());
  changes_.insert(changes_.end(), pending_.changes.begin(), pending_.changes.end());
  // The old view is destroyed with the next frame, outside the lock.
  if (!pending_.frames.empty()) newest_.swap(pending_.view);
  pending_.frames.clear();
  pending_.changes.clear();
  size_ = frames_.size();
}

void Scene::end(const std::filesystem::path& folder) {
  const std::scoped_lock lock(mutex_);
  apply_pending();
  folder_ = folder;
  ended_ = true;
}

void Scene::replace(SceneFrames frames, MapChanges map) {
  map.whole = true;
  const std::scoped_lock lock(mutex_);
  apply_pending();
  assert(frames.size() == frames_.size());
  frames_ = std::move(frames);
  changes_.push_back(std::make_shared<const MapChanges>(std::move(map)));
  ++edition_;
}

SceneFrames Scene::added() const {
  SceneFrames frames = frames_;  // others only read it
  frames.insert(frames.end(), pending_.frames.begin(), pending_.frames.end());
  return frames;
}

void Scene::set_loops(std::vector<SceneLoop> loops) {
  const std::scoped_lock lock(mutex_);
  loops_ = std::move(loops);
}

std::vector<SceneLoop> Scene::loops() const {
  const std::scoped_lock lock(mutex_);
  return loops_;
}

void Scene::replace_truth(const std::vector<std::optional<Eigen::Vector3d>>& truth) {
  const std::scoped_lock lock(mutex_);
  apply_pending();
  for (std::size_t i = 0; i < std::min(truth.size(), frames_.size()); ++i) {
    auto changed = std::make_shared<SceneFrame>(*frames_[i]);
    changed->truth = truth[i];
    frames_[i] = std::move(changed);
  }
  ++edition_;
}

std::filesystem::path Scene::folder() const {
  const std::scoped_lock lock(mutex_);
  return folder_;
}

SceneFrames Scene::frames(std::size_t first, std::size_t last) const {
  const std::scoped_lock lock(mutex_);
  last = std::min(last, frames_.size());
  if (first >= last) return {};
  return {frames_.begin() + static_cast<std::ptrdiff_t>(first),
          frames_.begin() + static_cast<std::ptrdiff_t>(last)};
}

std::shared_ptr<const SensorView> Scene::view(std::optional<std::size_t> frame) const {
  if (loader_ && frame) return loader_(*frame);
  const std::scoped_lock lock(mutex_);
  if (frame && newest_ && newest_->frame != *frame) return nullptr;
  return newest_;
}

void Scene::apply_map_changes() {
  Changes changes;
  {
    const std::scoped_lock lock(mutex_);
    changes.swap(changes_);
  }
  for (const auto& change : changes) map_.apply(*change);
}

}  // namespace mms
