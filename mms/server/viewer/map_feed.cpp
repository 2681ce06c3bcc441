#include "mms/server/viewer/map_feed.hpp"

#include <algorithm>

namespace mms {
namespace {

constexpr int kCoarsest = MapChunks::kLevels - 1;
/// A map of at most this many points is sent without a coarse level first.
constexpr std::size_t kSmallMap = 100'000;

/// Points of a chunk at a level: doubling the voxel side leaves a quarter of a surface's voxels.
std::size_t points_at(std::size_t points, int level) {
  return points >> (2 * level);
}

std::size_t total(const std::vector<ChunkState>& map) {
  std::size_t points = 0;
  for (const ChunkState& chunk : map) points += chunk.points;
  return points;
}

}  // namespace

std::vector<MapFeed::Candidate> MapFeed::candidates(const std::vector<ChunkState>& map,
                                                    const Eigen::Vector3f& focus) const {
  std::vector<Candidate> chunks;
  chunks.reserve(map.size());
  std::size_t coarse = 0;  // points of chunks not yet refined
  for (const ChunkState& chunk : map) {
    chunks.push_back({&chunk, (chunk.center - focus).norm(), kCoarsest});
    coarse += points_at(chunk.points, kCoarsest);
  }
  std::sort(chunks.begin(), chunks.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.chunk->key < b.chunk->key;
  });
  std::size_t left = budget_ - std::min(budget_, coarse);
  for (Candidate& want : chunks) {
    const std::size_t now = points_at(want.chunk->points, kCoarsest);
    for (int level = 0; level < kCoarsest; ++level) {
      const std::size_t more = points_at(want.chunk->points, level) - now;
      if (more > left) continue;
      want.level = level;
      left -= more;
      break;
    }
  }
  return chunks;
}

void MapFeed::queue_gone(const std::vector<ChunkState>& map) {
  std::vector<VoxelKey> there;
  for (const ChunkState& chunk : map) there.push_back(chunk.key);
  std::sort(there.begin(), there.end());
  for (const auto& [key, sent] : sent_) {
    if (!std::binary_search(there.begin(), there.end(), key)) queue_.push_back({key, 0, 0});
  }
}

void MapFeed::plan(const std::vector<ChunkState>& map, const Eigen::Vector3f& focus,
                   Clock::time_point now) {
  queue_.clear();
  deferred_ = false;
  queue_gone(map);
  const std::vector<Candidate> chunks = candidates(map, focus);
  const bool coarse_first = total(map) > kSmallMap;
  std::deque<ChunkTask> changed;
  std::deque<ChunkTask> finer;
  for (const Candidate& want : chunks) {
    const ChunkState& chunk = *want.chunk;
    const auto sent = sent_.find(chunk.key);
    if (sent == sent_.end()) {
      queue_.push_back({chunk.key, coarse_first ? kCoarsest : want.level, chunk.version});
      if (coarse_first && want.level < kCoarsest) {
        finer.push_back({chunk.key, want.level, chunk.version});
      }
    } else if (sent->second.level != want.level) {
      finer.push_back({chunk.key, want.level, chunk.version});
    } else if (sent->second.version != chunk.version) {
      const bool young = now - sent->second.when < kRefresh;
      deferred_ = deferred_ || young;
      if (!young) changed.push_back({chunk.key, want.level, chunk.version});
    }
  }
  queue_.insert(queue_.end(), changed.begin(), changed.end());
  queue_.insert(queue_.end(), finer.begin(), finer.end());
}

std::optional<ChunkTask> MapFeed::next(Clock::time_point now) {
  if (queue_.empty()) return std::nullopt;
  const ChunkTask task = queue_.front();
  queue_.pop_front();
  if (task.version == 0) {
    sent_.erase(task.key);
  } else {
    sent_[task.key] = {task.version, task.level, now};
  }
  return task;
}

}  // namespace mms
