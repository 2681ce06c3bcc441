#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "mms/core/segmentation.hpp"
#include "mms/fusion/clouds/nodes.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// The dynamic objects of a frame on the level of its nodes.
struct DynamicObjects {
  static constexpr int kNone = -1;

  struct Object {
    int instance = 0;         ///< index of the mask that gives its class
    Eigen::AlignedBox3f box;  ///< without stray points [m]
  };
  std::vector<int> label;           ///< object of every node, kNone for static ones
  std::vector<std::uint8_t> loose;  ///< non-zero at masked nodes in no cluster
  std::vector<Object> objects;
};

/// Finds the dynamic parts of `nodes`; those of one instance that fit into one object of its class
/// (a person seen above and below a table) are one object. Parts too far behind or in front of the
/// largest are another object: background that an inaccurate mask covers.
DynamicObjects find_dynamic_objects(const Nodes& nodes, const std::vector<Instance>& instances,
                                    const FusionConfig& config);

}  // namespace mms
