#include "mms/segmentation/solo/network_config.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace mms {
namespace {

constexpr std::array<std::string_view, 3> kSizes = {"nano", "r18", "r50"};
constexpr std::array<std::string_view, 4> kVariants = {"solov2", "solov2+rfp", "solov2+sac",
                                                       "solov2+detectors"};
constexpr std::array<std::string_view, 3> kSacModes = {"none", "plain", "deformable"};
constexpr std::array<std::string_view, 2> kNorms = {"gn", "bn"};

/// SOLOv2-light: 448 px on the short side, towers of two convolutions.
NetworkConfig r18() {
  NetworkConfig config;
  config.long_side = 768;
  config.short_side = 448;
  config.backbone = {.depth = 18};
  config.neck = {};
  config.head = {.tower_channels = 256,
                 .tower_depth = 2,
                 .kernel_channels = 128,
                 .object_scale = 56,
                 .norm = HeadNorm::kBatch};
  return config;
}

NetworkConfig r50() {
  NetworkConfig config;
  config.long_side = 1333;
  config.short_side = 800;
  config.backbone = {};
  config.neck = {};
  config.head = {};
  return config;
}

NetworkConfig sized(NetworkSize size) {
  switch (size) {
    case NetworkSize::kR18:
      return r18();
    case NetworkSize::kR50:
      return r50();
    case NetworkSize::kNano:
      break;
  }
  return {};
}

}  // namespace

void BackboneConfig::visit(ConfigVisitor& v) {
  constexpr std::array<std::string_view, 3> kDepths = {"18", "34", "50"};
  constexpr std::array<int, 3> kLayers = {18, 34, 50};
  int index = static_cast<int>(std::find(kLayers.begin(), kLayers.end(), depth) - kLayers.begin());
  v.choice({"depth", "", "layers of the ResNet"}, index, kDepths);
  depth = kLayers[static_cast<std::size_t>(index)];
  v.integer({"last_planes", "", "planes of stage 4; 512 in ResNet"}, last_planes, {16, 512});
  v.enumeration({"sac", "", "switchable atrous convolution in stages 2 to 4"}, sac, kSacModes);
}

void NeckConfig::visit(ConfigVisitor& v) {
  v.integer({"channels", "", "of the feature pyramid, a multiple of 4"}, channels, {8, 512});
  v.boolean({"recursive", "", "recursive feature pyramid: backbone and pyramid run twice"},
            recursive);
}

void HeadConfig::visit(ConfigVisitor& v) {
  v.integer({"tower_channels", "", "of the kernel and category towers"}, tower_channels, {8, 1024});
  v.integer({"tower_depth", "", "convolutions per tower"}, tower_depth, {1, 8});
  v.boolean({"shared_tower", "", "one tower for kernels and categories"}, shared_tower);
  v.integer({"kernel_channels", "", "of the mask features, and of a kernel"}, kernel_channels,
            {8, 512});
  v.integer({"mask_channels", "", "hidden channels of the mask-feature branch"}, mask_channels,
            {8, 512});
  v.number({"grid_density", "", "factor of SOLOv2's 40, 36, 24, 16 and 12 cells per side"},
           grid_density, {0.2, 2.0});
  v.number({"object_scale", "px", "largest object of the finest grid, square root of its box area"},
           object_scale, {4.0, 400.0});
  v.enumeration({"norm", "", "normalization in the heads"}, norm, kNorms);
  v.boolean(
      {"level_norms", "", "statistics of the towers' batch norms for each level of the pyramid"},
      level_norms);
  v.boolean({"window", "", "masks have a predicted window around their cell"}, window);
}

std::array<int, HeadConfig::kLevels> HeadConfig::grids() const {
  std::array<int, kLevels> cells = {40, 36, 24, 16, 12};
  for (int& side : cells) side = static_cast<int>(std::lround(grid_density * side));
  return cells;
}

std::array<Range, HeadConfig::kLevels> HeadConfig::scale_ranges() const {
  const double s = object_scale;
  constexpr double kAnyLarger = 1e9;
  return {Range{1.0, s}, {s / 2, 2 * s}, {s, 4 * s}, {2 * s, 8 * s}, {4 * s, kAnyLarger}};
}

NetworkConfig NetworkConfig::preset(NetworkSize size, NetworkVariant variant) {
  NetworkConfig config = sized(size);
  config.size = size;
  config.variant = variant;
  config.neck.recursive = variant == NetworkVariant::kRfp || variant == NetworkVariant::kDetectors;
  const bool switchable = variant == NetworkVariant::kSac || variant == NetworkVariant::kDetectors;
  const SacMode sac = size == NetworkSize::kR50 ? SacMode::kDeformable : SacMode::kPlain;
  config.backbone.sac = switchable ? sac : SacMode::kNone;
  return config;
}

void NetworkConfig::visit(ConfigVisitor& v) {
  const NetworkSize size_before = size;
  const NetworkVariant variant_before = variant;
  v.enumeration({"size", "", "size of the network; sets all values that are not given"}, size,
                kSizes);
  v.enumeration({"variant", "", "row of the paper's Table I; sets sac and recursive"}, variant,
                kVariants);
  if (size != size_before || variant != variant_before) {
    const int classes_before = classes;
    *this = preset(size, variant);
    classes = classes_before;
  }
  v.integer({"classes", "", "object classes"}, classes, {1, 1000});
  v.integer({"long_side", "px", "images are scaled to fit into long_side x short_side"}, long_side,
            {96, 4096});
  v.integer({"short_side", "px", "see long_side"}, short_side, {96, 4096});
  v.group({"backbone", "", "ResNet"}, backbone);
  v.group({"neck", "", "feature pyramid"}, neck);
  v.group({"head", "", "SOLOv2"}, head);
}

}  // namespace mms
