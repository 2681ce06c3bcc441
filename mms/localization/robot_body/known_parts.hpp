#pragma once

#include <cstdint>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/localization/odometry.hpp"
#include "mms/localization/robot_body/depth_view.hpp"

namespace mms {

/// The parts of the robot that were found in the image of a depth camera.
class KnownParts {
 public:
  /// Adds nodes of a view, each with its depth there.
  /// @param nodes  not 0: of a part; of the size of the view's nodes
  void add(const DepthView& view, const Image<std::uint8_t>& nodes);

  /// Makes the points of the parts invalid. Nodes that show something behind a part for some frames
  /// are none of it.
  void exclude(LabeledCloud& cloud, FeatureCloud& features);

  /// Share of the image that shows the parts, in [0, 1].
  double share() const;

 private:
  void forget_uncovered(const LabeledCloud& cloud);
  void set_limits();

  // Of nodes:
  Image<float> parts_;          // depth of the part there [m], 0 for none
  Image<float> limits_;         // depth up to which points are of the parts around [m], 0 for none
  Image<std::uint8_t> misses_;  // frames in a row that showed what is behind the part
};

}  // namespace mms
