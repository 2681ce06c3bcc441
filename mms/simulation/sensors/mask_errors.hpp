#pragma once

#include <cstdint>
#include <span>

#include "mms/core/config.hpp"
#include "mms/core/image.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// How a segmentation network falls short of the exact masks (the paper's III-B: eroded edges,
/// parts that motion blur hides, objects missed for some frames). Every share is of the frames of
/// one object and comes in spells; objects fail independently of each other.
struct MaskErrorConfig {
  bool enabled = false;
  double missed = 0.15;  ///< share of an object's frames without any mask
  double spell = 4.0;    ///< mean length of every kind of spell [frames]
  /// Mean retreat of the boundary [px of a 640 px wide image]; less on objects narrower than five
  /// times that, which would vanish.
  double erosion = 3.0;
  double boundary_jitter = 3.0;  ///< how much the retreat varies along the boundary [px of 640]
  double lost_parts = 0.15;  ///< share of frames in which an object lacks a part (legs, arm, half)
  double spill = 0.1;        ///< share of frames in which the mask covers some background too

  void visit(ConfigVisitor& v);
};

/// Label image (0 static, else 1 + class id) a network would give for exact instances (0 static,
/// else 1 + object id) of frame `index`; `classes` is indexed by object id, objects beyond it are
/// static. Any frame can be asked for, in any order; frames that follow each other fail alike. A
/// mask never covers pixels of another object. Spells longer than `spell` where `missed` (or
/// another share) leaves less than a frame between them: at least share / (1 - share) frames.
Image<std::uint8_t> imperfect_masks(const Image<std::uint8_t>& instances,
                                    std::span<const ObjectClass> classes,
                                    const MaskErrorConfig& config, std::uint64_t seed, int index);

}  // namespace mms
