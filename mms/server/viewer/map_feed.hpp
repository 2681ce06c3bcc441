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

/// Next chunk to send.
struct ChunkTask {
  VoxelKey key;
  int level = 0;
  std::uint64_t version = 0;
};

/// Selects for one viewer which chunks of the map to send, and their order: first unsent chunks,
/// coarse and near ones first; then changed ones; then refinements, near ones first, within the
/// viewer's point budget. Stores keys, not points: the newest state is sent.
class MapFeed {
 public:
  using Clock = std::chrono::steady_clock;

  /// Shortest time between two transmissions of a chunk.
  static constexpr std::chrono::milliseconds kRefresh{1000};

  explicit MapFeed(std::size_t budget) : budget_(budget) {}

  void set_budget(std::size_t points) { budget_ = points; }

  /// Recomputes the plan.
  /// @param focus  point that the viewer observes, world frame [m]
  void plan(const std::vector<ChunkState>& map, const Eigen::Vector3f& focus,
            Clock::time_point now);

  /// The next chunk of the plan, marked as sent; nullopt if the viewer is up to date.
  std::optional<ChunkTask> next(Clock::time_point now);

  /// Whether the last plan deferred chunks that were sent recently.
  bool deferred() const { return deferred_; }

 private:
  struct Sent {
    std::uint64_t version = 0;
    int level = 0;
    Clock::time_point when;
  };
  struct Candidate {
    const ChunkState* chunk = nullptr;
    float distance = 0.0F;
    int level = 0;
  };

  std::vector<Candidate> candidates(const std::vector<ChunkState>& map,
                                    const Eigen::Vector3f& focus) const;
  void queue_gone(const std::vector<ChunkState>& map);

  std::size_t budget_;
  std::map<VoxelKey, Sent> sent_;
  std::deque<ChunkTask> queue_;
  bool deferred_ = false;
};

}  // namespace mms
