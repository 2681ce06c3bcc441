#include "mms/ros/growing_path.hpp"

#include <utility>
#include <vector>

namespace mms {

void GrowingPath::add(const msg::Header& header, const msg::Pose& pose) {
  path_.header = header;
  const bool last_stays = added_ == 0 || (added_ - 1) % stride_ == 0;
  if (!last_stays) path_.poses.pop_back();
  path_.poses.push_back({header, pose});
  ++added_;
  if (path_.poses.size() > kMaxPoses) halve();
}

/// Removes every second pose but the latest one, which stays until the next one comes.
void GrowingPath::halve() {
  std::vector<msg::PoseStamped>& poses = path_.poses;
  std::size_t kept = 1;
  for (std::size_t i = 2; i + 1 < poses.size(); i += 2) poses[kept++] = std::move(poses[i]);
  poses[kept++] = std::move(poses.back());
  poses.resize(kept);
  stride_ *= 2;
}

}  // namespace mms
