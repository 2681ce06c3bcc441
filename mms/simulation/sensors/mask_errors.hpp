#pragma once

#include <cstdint>
#include <span>

#include "mms/core/config_visitor.hpp"
#include "mms/core/image.hpp"
#include "mms/core/segmentation.hpp"

namespace mms {

/// Errors of masks, like those of a segmentation network (III-B: eroded edges, parts lost by motion
/// blur, objects missed for some frames). Shares are of the frames of one object and occur in
/// periods; objects are independent.
struct MaskErrorConfig {
  bool enabled = false;
  double missed = 0.15;  ///< share of an object's frames without mask
  double spell = 4.0;    ///< mean duration of each error [frames]
  /// Mean erosion of the boundary [px of a 640 px wide image]; less for objects narrower than five
  /// times this value, which would vanish.
  double erosion = 3.0;
  double boundary_jitter = 3.0;  ///< variation of the erosion along the boundary [px of 640]
  double lost_parts =
      0.15;  ///< share of frames in which a part of an object is missing (legs, arm, half)
  double spill = 0.1;  ///< share of frames in which the mask covers background

  void visit(ConfigVisitor& v);
};

/// Label image (0 static, else 1 + class id) with errors, for exact instances (0 static, else 1 +
/// object id) of frame `index`; `classes` is indexed by object id, objects beyond it are static.
/// Frames are independent of order; errors of consecutive frames are correlated. A mask never
/// covers pixels of another object. Periods are longer than `spell` if `missed` (or another share)
/// leaves less than a frame between them: at least share / (1 - share) frames.
Image<std::uint8_t> imperfect_masks(const Image<std::uint8_t>& instances,
                                    std::span<const ObjectClass> classes,
                                    const MaskErrorConfig& config, std::uint64_t seed, int index);

}  // namespace mms
