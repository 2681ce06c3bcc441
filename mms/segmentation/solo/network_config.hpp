#pragma once

#include <array>

#include "mms/core/config_visitor.hpp"

namespace mms {

/// Size of a network: the paper's (SOLOv2 with ResNet-50), the light one with ResNet-18, and one
/// for small computers with at most 10 GFLOP at 256x320.
enum class NetworkSize { kNano, kR18, kR50 };

/// The rows of the paper's Table I.
enum class NetworkVariant { kSolov2, kRfp, kSac, kDetectors };

/// Switchable atrous convolution in the stages 2 to 4 of the backbone.
enum class SacMode { kNone, kPlain, kDeformable };

/// Normalization in the heads; batch norm is folded into the convolutions at inference.
enum class HeadNorm { kGroup, kBatch };

/// ResNet: plain blocks at depths 18 and 34, bottlenecks at 50.
struct BackboneConfig {
  int depth = 50;         ///< 18, 34 or 50 layers
  int last_planes = 512;  ///< of stage 4; 512 in ResNet
  SacMode sac = SacMode::kNone;

  void visit(ConfigVisitor& v);
};

/// Feature pyramid P2 to P6.
struct NeckConfig {
  int channels = 256;
  bool recursive = false;  ///< RFP with two steps

  void visit(ConfigVisitor& v);
};

/// SOLOv2's kernel, category and mask-feature branches.
struct HeadConfig {
  int tower_channels = 512;
  int tower_depth = 4;        ///< 3x3 convolutions before the predictions
  bool shared_tower = false;  ///< one tower for kernels and categories
  int kernel_channels = 256;  ///< E: of the mask features, and length of a kernel
  int mask_channels = 128;    ///< hidden channels of the mask-feature branch
  double grid_density = 1.0;  ///< factor of SOLOv2's 40, 36, 24, 16, 12 cells per side
  double object_scale =
      96;  ///< largest object of the finest grid, square root of its box area [px]
  HeadNorm norm = HeadNorm::kGroup;
  bool level_norms = false;  ///< batch norms of the towers have statistics for each level
  bool window = false;       ///< kernels have `kWindowTerms` more values: a window around the cell

  void visit(ConfigVisitor& v);

  static constexpr int kLevels = 5;
  /// The values a, b, c, d after a kernel. At x cell widths and y cell heights from the center of
  /// the kernel's cell they add c x + d y - softplus(a) x^2 - softplus(b) y^2 to the logit of the
  /// mask. Relative positions separate adjacent people (as in CondInst, Tian et al., ECCV 2020).
  static constexpr int kWindowTerms = 4;
  /// Values of a kernel.
  int kernel_length() const { return kernel_channels + (window ? kWindowTerms : 0); }
  /// Cells per side of each level.
  std::array<int, kLevels> grids() const;
  /// Closed range of sqrt(box area) [px of the network's input] of a level's objects; adjacent
  /// ranges overlap.
  std::array<Range, kLevels> scale_ranges() const;
};

/// Architecture of the segmentation network (III-A), which determines the tensors of a weights
/// file.
struct NetworkConfig {
  NetworkSize size = NetworkSize::kNano;
  NetworkVariant variant = NetworkVariant::kSolov2;
  int classes = 2;
  int long_side = 320;   ///< images are scaled to fit into long_side x short_side [px],
  int short_side = 240;  ///< in either orientation
  BackboneConfig backbone{.depth = 18, .last_planes = 256};
  NeckConfig neck{.channels = 64};
  HeadConfig head{.tower_channels = 128,
                  .tower_depth = 2,
                  .shared_tower = true,
                  .kernel_channels = 64,
                  .mask_channels = 64,
                  .grid_density = 0.6,
                  .object_scale = 32,
                  .norm = HeadNorm::kBatch};

  /// The settings of a size and a row of Table I.
  static NetworkConfig preset(NetworkSize size, NetworkVariant variant);

  /// Changing size or variant also sets the other values of its preset.
  void visit(ConfigVisitor& v);
};

}  // namespace mms
