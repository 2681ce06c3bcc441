#include "mms/server/scene/viewer_scene.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "mms/core/error.hpp"

namespace mms {
namespace {

constexpr std::size_t kBatch = 512;  ///< frames read together, while none can be added

}  // namespace

Scene::Scene(SceneInfo info, int min_observations)
    : info_(std::move(info)),
      frames_(std::make_unique<DiskLog<SceneFrame>>()),
      map_(min_observations) {}

void Scene::keep_on_disk(const std::filesystem::path& folder) {
  const std::scoped_lock lock(mutex_);
  disk_ = folder;
  frames_ = std::make_unique<DiskLog<SceneFrame>>(disk_);
}

void Scene::set_sensor(const std::optional<CameraIntrinsics>& camera, const Eigen::Vector3d& up) {
  info_.camera = camera;
  info_.up = up;
}

void Scene::add(SceneFrame frame, std::shared_ptr<const SensorView> view,
                std::shared_ptr<const MapChanges> map) {
  pending_.frames.push_back(std::move(frame));
  pending_.view = std::move(view);
  if (map) pending_.changes.push_back(std::move(map));
  const std::unique_lock lock(mutex_, std::try_to_lock);
  // Does not wait for a reader, which may have low priority.
  if (lock.owns_lock()) apply_pending();
}

void Scene::apply_pending() {
  const bool has_frames = !pending_.frames.empty();
  for (SceneFrame& frame : pending_.frames) {
    stamps_.push_back(frame.stamp);
    frames_->add(std::move(frame));
  }
  changes_.insert(changes_.end(), pending_.changes.begin(), pending_.changes.end());
  // The old view is destroyed with the next frame, outside the lock.
  if (has_frames) newest_.swap(pending_.view);
  pending_.frames.clear();
  pending_.changes.clear();
  size_ = frames_->size();
}

void Scene::end(const std::filesystem::path& folder) {
  const std::scoped_lock lock(mutex_);
  apply_pending();
  folder_ = folder;
  ended_ = true;
}

void Scene::change(const ChangeFrame& change, std::shared_ptr<const MapChanges> map) {
  {
    const std::scoped_lock lock(mutex_);
    apply_pending();
  }
  auto changed = std::make_unique<DiskLog<SceneFrame>>(disk_);
  for_each_frame(0, size_, [&](SceneFrame frame) {
    change(changed->size(), frame);
    changed->add(std::move(frame));
  });
  const std::scoped_lock lock(mutex_);
  frames_.swap(changed);  // the old ones are removed outside the lock
  if (map) changes_.push_back(std::move(map));
  ++edition_;
}

void Scene::set_loops(std::vector<SceneLoop> loops) {
  const std::scoped_lock lock(mutex_);
  loops_ = std::move(loops);
}

std::vector<SceneLoop> Scene::loops() const {
  const std::scoped_lock lock(mutex_);
  return loops_;
}

std::filesystem::path Scene::folder() const {
  const std::scoped_lock lock(mutex_);
  return folder_;
}

std::vector<SceneFrame> Scene::read_frames(std::size_t first, std::size_t last) const {
  const std::scoped_lock lock(mutex_);
  return frames_->read(first, last);
}

SceneFrame Scene::frame(std::size_t index) const {
  std::vector<SceneFrame> frames = read_frames(index, index + 1);
  if (frames.empty()) throw DataError("frame " + std::to_string(index), "is not in the run");
  return std::move(frames.front());
}

void Scene::for_each_frame(std::size_t first, std::size_t last,
                           const std::function<void(const SceneFrame&)>& use) const {
  while (first < last) {
    const std::vector<SceneFrame> frames = read_frames(first, std::min(last, first + kBatch));
    if (frames.empty()) return;
    for (const SceneFrame& frame : frames) use(frame);
    first += frames.size();
  }
}

std::vector<Timestamp> Scene::stamps() const {
  const std::scoped_lock lock(mutex_);
  return stamps_;
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
