#include "mms/server/scene/scene.hpp"

#include <algorithm>
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
  // A reader that the system has put to sleep, as one of low priority may be, holds nobody up.
  if (lock.owns_lock()) take_over_pending();
}

void Scene::take_over_pending() {
  frames_.insert(frames_.end(), pending_.frames.begin(), pending_.frames.end());
  changes_.insert(changes_.end(), pending_.changes.begin(), pending_.changes.end());
  // The old view goes with the next frame, when no lock is held.
  if (!pending_.frames.empty()) newest_.swap(pending_.view);
  pending_.frames.clear();
  pending_.changes.clear();
  size_ = frames_.size();
}

void Scene::end(const std::filesystem::path& folder) {
  const std::scoped_lock lock(mutex_);
  take_over_pending();
  folder_ = folder;
  ended_ = true;
}

void Scene::replace_truth(const std::vector<std::optional<Eigen::Vector3d>>& truth) {
  const std::scoped_lock lock(mutex_);
  take_over_pending();
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

void Scene::take_over_map() {
  Changes changes;
  {
    const std::scoped_lock lock(mutex_);
    changes.swap(changes_);
  }
  for (const auto& change : changes) map_.apply(*change);
}

}  // namespace mms
