#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mms/core/time.hpp"

namespace mms {

/// Sensor positions of a map's frames, numbered from 1. Those that no voxel refers to are pruned,
/// so that memory follows the size of the map and not the length of the run.
class FrameViewpoints {
 public:
  struct Entry {
    std::uint32_t frame = 0;    ///< its number
    Eigen::Vector3f viewpoint;  ///< in the world frame [m]
    Timestamp stamp;            ///< of the frame
  };

  /// @param viewpoint  in the world frame [m]
  void add(const Eigen::Vector3f& viewpoint, Timestamp stamp = {}) {
    entries_.push_back({++last_, viewpoint, stamp});
  }

  /// Number of the frame added last; 0 before the first.
  std::uint32_t last() const { return last_; }

  /// @param frame  number of a frame that was not pruned
  const Eigen::Vector3f& at(std::uint32_t frame) const;

  /// Whether the entries have doubled since the last pruning.
  bool wants_pruning() const { return entries_.size() >= limit_; }

  /// Removes the viewpoints that are not needed.
  /// @param is_needed  by frame number, for 0 to `last`
  void prune(const std::vector<bool>& is_needed);

  std::size_t size() const { return entries_.size(); }
  const std::vector<Entry>& entries() const { return entries_; }  ///< by frame number

 private:
  /// [-]: entries before the first pruning. Source: 64 KiB of memory.
  static constexpr std::size_t kFirstLimit = 4096;

  std::vector<Entry> entries_;  // by frame
  std::uint32_t last_ = 0;
  std::size_t limit_ = kFirstLimit;
};

}  // namespace mms
