#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mms/segmentation/solo/network_config.hpp"
#include "mms/training/data/sample.hpp"

namespace mms {

/// Targets of the head for one image.
struct ImageTargets {
  static constexpr int kBackground = -1;
  static constexpr int kIgnored = -2;  ///< cells on a crowd

  /// A cell of a level that predicts the mask of an object.
  struct Pair {
    int level = 0;
    int cell = 0;    ///< row-major in the level's grid
    int object = 0;  ///< index in `masks`
  };

  /// Class of each cell, row-major, or one of the two constants above.
  std::array<std::vector<int>, HeadConfig::kLevels> categories;
  std::vector<Pair> pairs;
  std::vector<Image<std::uint8_t>> masks;  ///< at a quarter of the input's size: 0 or 1
  std::vector<bool> box_only;  ///< of `masks`: the box of an object without a known mask
  std::vector<int> partial;    ///< classes without a loss on background cells
};

/// Assigns the objects of an image to grid cells as in SOLOv2: every level whose range contains the
/// square root of the box's area, in the cells of the central fifth of the box around the mask's
/// center of mass, at most 3x3. A cell in which several objects are is that of the smallest one, as
/// in FCOS (Tian et al., ICCV 2019): it can predict one mask only.
ImageTargets assign_targets(const Sample& sample, const HeadConfig& head);

}  // namespace mms
