#include "mms/segmentation/weights/operation_count.hpp"

#include <string>
#include <string_view>

#include "mms/segmentation/weights/tensor_shapes.hpp"

namespace mms {
namespace {

/// Rest of a name after a prefix; empty if the prefix differs.
std::string_view after(std::string_view name, std::string_view prefix) {
  return name.starts_with(prefix) ? name.substr(prefix.size()) : std::string_view();
}

/// Number of positions of a tensor's kernel.
class Positions {
 public:
  Positions(const NetworkConfig& config, int width, int height)
      : config_(config), width_(width), height_(height) {}

  std::int64_t of(std::string_view name) const {
    if (const auto rest = after(name, "neck.rfp_modules.0."); !rest.empty()) return backbone(rest);
    if (const auto rest = after(name, "backbone."); !rest.empty()) return backbone(rest);
    if (const auto rest = after(name, "neck."); !rest.empty()) return neck(rest);
    return head(after(name, "mask_head."));
  }

 private:
  std::int64_t at_stride(int stride) const {
    return static_cast<std::int64_t>(width_ / stride) * (height_ / stride);
  }

  /// "conv1.weight", "layer2.0.conv2.weight", "layer3.1.conv2.switch.weight", ...
  std::int64_t backbone(std::string_view name) const {
    if (name.starts_with("conv1")) return at_stride(2);
    if (name.find("_context") != std::string_view::npos) return 1;
    const int stride = 2 << (name[5] - '0');
    const bool before_stride =
        config_.backbone.depth >= 50 && stride > 4 && name.substr(7).starts_with("0.conv1");
    return at_stride(before_stride ? stride / 2 : stride);
  }

  std::int64_t neck(std::string_view name) const {
    const std::int64_t looks = config_.neck.recursive ? 2 : 1;
    for (const std::string_view convolutions : {"lateral_convs.", "fpn_convs."}) {
      const auto level = after(name, convolutions);
      if (!level.empty()) return looks * at_stride(4 << (level[0] - '0'));
    }
    if (name.starts_with("rfp_aspp.aspp.3")) return 3;  // of the means of three levels
    const std::int64_t fed_back = at_stride(8) + at_stride(16) + at_stride(32);
    return name.starts_with("rfp_aspp") ? fed_back : fed_back + at_stride(4) + at_stride(64);
  }

  std::int64_t head(std::string_view name) const {
    const auto level = after(name, "mask_feature_head.convs_all_levels.");
    if (!level.empty()) {  // "2.conv1.conv.weight": each one on a map of twice the size
      const int doublings = level[6] - '0';
      return at_stride((4 << (level[0] - '0')) >> doublings);
    }
    if (name.starts_with("mask_feature_head.")) return at_stride(4);
    std::int64_t cells = 0;
    for (const int side : config_.head.grids()) cells += static_cast<std::int64_t>(side) * side;
    return cells;
  }

  const NetworkConfig& config_;
  int width_;
  int height_;
};

}  // namespace

std::int64_t network_operations(const NetworkConfig& config, int width, int height) {
  const Positions positions(config, width, height);
  std::int64_t sum = 0;
  for (const auto& [name, shape] : expected_tensors(config)) {
    const bool kernel = name.ends_with(".weight") || name.ends_with(".weight_diff");
    if (!kernel || shape.size() != 4) continue;
    sum += 2 * positions.of(name) * static_cast<std::int64_t>(value_count(shape));
  }
  return sum;
}

std::int64_t network_parameters(const NetworkConfig& config) {
  std::int64_t sum = 0;
  for (const auto& [name, shape] : expected_tensors(config)) {
    sum += static_cast<std::int64_t>(value_count(shape));
  }
  return sum;
}

}  // namespace mms
