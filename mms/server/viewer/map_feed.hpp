#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "mms/server/scene/map_chunks.hpp"

namespace mms {

/// A chunk to be sent next.
struct ChunkTask {
  VoxelKey key;
  int level = 0;
  std::uint64_t version = 0;
};

/// Decides for one viewer which chunks of the map it is sent, and in which order: first what it has
/// nothing of, coarse and near things first; then what has changed; then all finer, near things
/// first, as long as the points it can draw suffice. Holds keys, no points: what is sent is always
/// the newest.
class MapFeed {
 public:
  using Clock = std::chrono::steady_clock;

  /// A chunk that keeps changing is sent again this long after it was sent.
  static constexpr std::chrono::milliseconds kRefresh{1000};

  explicit MapFeed(std::size_t budget) : budget_(budget) {}

  void set_budget(std::size_t points) { budget_ = points; }

  /// Plans anew. @param focus  where the viewer views, world frame [m]
  void plan(const std::vector<ChunkState>& map, const Eigen::Vector3f& focus,
            Clock::time_point now);

  /// The next chunk of the plan, which counts as sent; nothing when the viewer has all of it.
  std::optional<ChunkTask> next(Clock::time_point now);

  /// Whether the last plan left out chunks that were sent a moment ago.
  bool deferred() const { return deferred_; }

 private:
  struct Sent {
    std::uint64_t version = 0;
    int level = 0;
    Clock::time_point when;
  };
  struct Wanted {
    const ChunkState* chunk = nullptr;
    float distance = 0.0F;
    int level = 0;
  };

  std::vector<Wanted> wanted(const std::vector<ChunkState>& map,
                             const Eigen::Vector3f& focus) const;
  void queue_gone(const std::vector<ChunkState>& map);

  std::size_t budget_;
  std::map<VoxelKey, Sent> sent_;
  std::deque<ChunkTask> queue_;
  bool deferred_ = false;
};

}  // namespace mms
