#include "mms/segmentation/weights/checkpoint_names.hpp"

#include <array>
#include <charconv>
#include <string_view>

namespace mms {
namespace {

struct Replacement {
  std::string_view from;
  std::string_view to;
};

constexpr std::string_view kDetectronBackbone = "backbone.bottom_up.";

constexpr std::array<std::string_view, 3> kWrappers = {"state_dict.", "model.", "module."};

// Prefixes of names. The first match counts.
constexpr std::array<Replacement, 25> kBeginnings = {{
    // WXinlong/SOLO
    {"bbox_head.cate_convs.", "mask_head.cls_convs."},
    {"bbox_head.kernel_convs.", "mask_head.kernel_convs."},
    {"bbox_head.solo_cate.", "mask_head.conv_cls."},
    {"bbox_head.solo_kernel.", "mask_head.conv_kernel."},
    {"mask_feat_head.conv_pred.0.", "mask_head.mask_feature_head.conv_pred."},
    {"mask_feat_head.", "mask_head.mask_feature_head."},
    // AdelaiDet
    {"ins_head.cate_pred.", "mask_head.conv_cls."},
    {"ins_head.kernel_pred.", "mask_head.conv_kernel."},
    {"mask_head.conv_pred.0.", "mask_head.mask_feature_head.conv_pred.conv."},
    {"mask_head.conv_pred.1.", "mask_head.mask_feature_head.conv_pred.gn."},
    {"mask_head.convs_all_levels.", "mask_head.mask_feature_head.convs_all_levels."},
    // detectron2
    {"backbone.bottom_up.stem.conv1.norm.", "backbone.bn1."},
    {"backbone.bottom_up.stem.", "backbone."},
    {"backbone.bottom_up.res2.", "backbone.layer1."},
    {"backbone.bottom_up.res3.", "backbone.layer2."},
    {"backbone.bottom_up.res4.", "backbone.layer3."},
    {"backbone.bottom_up.res5.", "backbone.layer4."},
    {"backbone.fpn_lateral2.", "neck.lateral_convs.0.conv."},
    {"backbone.fpn_lateral3.", "neck.lateral_convs.1.conv."},
    {"backbone.fpn_lateral4.", "neck.lateral_convs.2.conv."},
    {"backbone.fpn_lateral5.", "neck.lateral_convs.3.conv."},
    {"backbone.fpn_output2.", "neck.fpn_convs.0.conv."},
    {"backbone.fpn_output3.", "neck.fpn_convs.1.conv."},
    {"backbone.fpn_output4.", "neck.fpn_convs.2.conv."},
    {"backbone.fpn_output5.", "neck.fpn_convs.3.conv."},
}};

// Inner parts, which no other framework's names contain.
constexpr std::array<Replacement, 11> kCenters = {{
    // detectron2
    {".conv1.norm.", ".bn1."},
    {".conv2.norm.", ".bn2."},
    {".conv3.norm.", ".bn3."},
    {".shortcut.norm.", ".downsample.1."},
    {".shortcut.", ".downsample.0."},
    // AdelaiDet's mask features
    {".conv0.0.", ".conv0.conv."},
    {".conv0.1.", ".conv0.gn."},
    {".conv1.0.", ".conv1.conv."},
    {".conv1.1.", ".conv1.gn."},
    {".conv2.0.", ".conv2.conv."},
    {".conv2.1.", ".conv2.gn."},
}};

/// Wrappers may be nested.
void unwrap(std::string& name) {
  for (bool again = true; again;) {
    again = false;
    for (const std::string_view wrapper : kWrappers) {
      if (!name.starts_with(wrapper)) continue;
      name.erase(0, wrapper.size());
      again = true;
    }
  }
}

void replace_beginning(std::string& name) {
  for (const auto& [from, to] : kBeginnings) {
    if (!name.starts_with(from)) continue;
    name.replace(0, from.size(), to);
    return;
  }
}

void replace_center(std::string& name) {
  for (const auto& [from, to] : kCenters) {
    const std::size_t at = name.find(from);
    if (at == std::string::npos) continue;
    name.replace(at, from.size(), to);
    return;
  }
}

/// AdelaiDet's towers number convolution, norm and ReLU separately: 0 and 1 belong to the first
/// unit, 3 and 4 to the second.
void replace_tower(std::string& name, std::string_view from, std::string_view to) {
  if (!name.starts_with(from)) return;
  constexpr int kLayersOfUnit = 3;
  int layer = 0;
  const char* end = name.data() + name.size();
  const auto [rest, fault] = std::from_chars(name.data() + from.size(), end, layer);
  if (fault != std::errc() || layer < 0 || layer % kLayersOfUnit > 1) return;
  name = std::string(to) + std::to_string(layer / kLayersOfUnit) +
         (layer % kLayersOfUnit == 0 ? ".conv" : ".gn") + std::string(rest, end);
}

}  // namespace

std::optional<std::string> network_name(std::string published) {
  if (published.ends_with(".num_batches_tracked")) return std::nullopt;
  unwrap(published);
  replace_beginning(published);
  replace_tower(published, "ins_head.cate_tower.", "mask_head.cls_convs.");
  replace_tower(published, "ins_head.kernel_tower.", "mask_head.kernel_convs.");
  replace_center(published);
  return published;
}

bool is_detectron_backbone(const std::string& published) {
  std::string name = published;
  unwrap(name);
  return name.starts_with(kDetectronBackbone);
}

}  // namespace mms
