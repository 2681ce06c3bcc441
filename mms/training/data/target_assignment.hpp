#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mms/segmentation/solo/network_config.hpp"
#include "mms/training/data/sample.hpp"

namespace mms {

/// What the head is to say of one image.
struct ImageTargets {
  static constexpr int kBackground = -1;
  static constexpr int kIgnored = -2;  ///< cells on a crowd

  /// A cell of a level that is to give the mask of an object.
  struct Pair {
    int level = 0;
    int cell = 0;    ///< row-major in the level's grid
    int object = 0;  ///< in `masks`
  };

  /// Class of each cell, row-major, or one of the two above.
  std::array<std::vector<int>, HeadConfig::kLevels> categories;
  std::vector<Pair> pairs;
  std::vector<Image<std::uint8_t>> masks;  ///< at a quarter of the input's size: 0 or 1
};

/// Assigns the objects of an image to grid cells as SOLOv2 does: every level whose range holds the
/// square root of the box's area takes the object, in the cells of the box's middle fifth about the
/// mask's centre of mass, at most 3x3. A later object takes a cell's class from an earlier one;
/// both keep their pair.
ImageTargets assign_targets(const Sample& sample, const HeadConfig& head);

}  // namespace mms
