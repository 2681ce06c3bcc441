#include "mms/mapping/static_map/frame_viewpoints.hpp"

#include <algorithm>
#include <cassert>

namespace mms {

const Eigen::Vector3f& FrameViewpoints::at(std::uint32_t frame) const {
  const auto entry = std::lower_bound(
      entries_.begin(), entries_.end(), frame,
      [](const Entry& candidate, std::uint32_t wanted) { return candidate.frame < wanted; });
  assert(entry != entries_.end() && entry->frame == frame);
  return entry->viewpoint;
}

void FrameViewpoints::prune(const std::vector<bool>& is_needed) {
  std::erase_if(entries_, [&](const Entry& entry) { return !is_needed[entry.frame]; });
  limit_ = std::max(kFirstLimit, 2 * entries_.size());
}

}  // namespace mms
