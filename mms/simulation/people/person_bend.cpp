#include "mms/simulation/people/person_bend.hpp"

#include <algorithm>
#include <cmath>

namespace mms {
namespace {

Eigen::Isometry3f bone(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                       const Eigen::Vector3f& hinge) {
  Eigen::Isometry3f T = Eigen::Isometry3f::Identity();
  const Eigen::Vector3f up = (from - to).normalized();
  T.linear().col(0) = hinge.cross(up);
  T.linear().col(1) = hinge;
  T.linear().col(2) = up;
  T.translation() = from;
  return T;
}

}  // namespace

BentLimb bend_limb(const Eigen::Vector3f& root, const Eigen::Vector3f& end,
                   const Eigen::Vector3f& front, float upper, float lower, bool knee) {
  const Eigen::Vector3f straight = end - root;
  const float reach = std::clamp(straight.norm(), std::abs(upper - lower) + 0.05F * upper,
                                 0.9995F * (upper + lower));
  const Eigen::Vector3f along = straight.normalized();
  const Eigen::Vector3f hinge = front.cross(along).normalized();
  const Eigen::Vector3f ahead = along.cross(hinge);
  const float foot = (upper * upper - lower * lower + reach * reach) / (2.0F * reach);
  const float off = std::sqrt(std::max(0.0F, upper * upper - foot * foot));
  const Eigen::Vector3f joint = root + foot * along + (knee ? off : -off) * ahead;
  return {bone(root, joint, hinge), bone(joint, root + reach * along, hinge)};
}

}  // namespace mms
