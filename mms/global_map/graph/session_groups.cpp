#include "mms/global_map/graph/session_groups.hpp"

#include <algorithm>

namespace mms {

void SessionGroups::add(std::size_t first) {
  sessions_.push_back({first, size()});
}

std::uint32_t SessionGroups::session_of(std::size_t keyframe) const {
  const auto next =
      std::upper_bound(sessions_.begin(), sessions_.end(), keyframe,
                       [](std::size_t k, const Session& session) { return k < session.first; });
  return static_cast<std::uint32_t>(next - sessions_.begin()) - 1U;
}

std::pair<std::size_t, std::size_t> SessionGroups::range(std::uint32_t session,
                                                         std::size_t count) const {
  const bool is_last = session + 1U == size();
  return {sessions_[session].first, is_last ? count : sessions_[session + 1U].first};
}

bool SessionGroups::join(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t from = std::max(group_of(a), group_of(b));
  const std::uint32_t to = std::min(group_of(a), group_of(b));
  for (Session& session : sessions_) {
    if (session.group == from) session.group = to;
  }
  return from != to;
}

}  // namespace mms
