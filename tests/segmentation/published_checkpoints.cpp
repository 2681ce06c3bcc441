#include "tests/segmentation/published_checkpoints.hpp"

#include <array>

namespace mms::testing {
namespace {

using Shape = std::vector<std::int64_t>;

constexpr int kClasses = 80;

/// Replaces each % of the pattern by a number.
std::string numbered(std::string pattern, std::initializer_list<int> numbers) {
  for (const int number : numbers) pattern.replace(pattern.find('%'), 1, std::to_string(number));
  return pattern;
}

/// Blocks and channels of a ResNet-50's stage.
struct Stage {
  int number;
  int blocks;
  std::int64_t planes;
  std::int64_t in;
  std::int64_t out;
};

constexpr std::array<Stage, 4> kStages = {
    {{1, 3, 64, 64, 256}, {2, 4, 128, 256, 512}, {3, 6, 256, 512, 1024}, {4, 3, 512, 1024, 2048}}};

class Checkpoint {
 public:
  explicit Checkpoint(Naming naming) : naming_(std::move(naming)) {}

  void add(const std::string& name, Shape shape) {
    std::size_t count = 1;
    for (const std::int64_t side : shape) count *= static_cast<std::size_t>(side);
    weights.tensors[naming_.prefix + name] = {std::move(shape),
                                              std::vector<float>(count, next_value_)};
    next_value_ += 1.0F;
  }

  void norm(const std::string& name, std::int64_t channels) {
    for (const char* part : {".weight", ".bias", ".running_mean", ".running_var"}) {
      add(name + part, {channels});
    }
    if (naming_.counters)
      weights.tensors[naming_.prefix + name + ".num_batches_tracked"] = {{}, {7}};
  }

  void biased(const std::string& name, Shape shape) {
    const std::int64_t out = shape[0];
    add(name + ".weight", std::move(shape));
    add(name + ".bias", {out});
  }

  void backbone() {
    add(naming_.stem_conv + ".weight", {64, 3, 7, 7});
    norm(naming_.stem_norm, 64);
    for (const Stage& s : kStages) {
      const int stage = naming_.first_stage + s.number - 1;
      for (int b = 0; b < s.blocks; ++b) {
        const auto layer = [&](int i, std::int64_t out, std::int64_t in, std::int64_t side) {
          add(numbered(naming_.block_conv, {stage, b, i}) + ".weight", {out, in, side, side});
          norm(numbered(naming_.block_norm, {stage, b, i}), out);
        };
        layer(1, s.planes, b == 0 ? s.in : s.out, 1);
        layer(2, s.planes, s.planes, 3);
        layer(3, s.out, s.planes, 1);
      }
      add(numbered(naming_.skip_conv, {stage}) + ".weight", {s.out, s.in, 1, 1});
      norm(numbered(naming_.skip_norm, {stage}), s.out);
    }
  }

  void neck() {
    for (const Stage& s : kStages) {
      const int level = naming_.first_level + s.number - 1;
      biased(numbered(naming_.lateral, {level}), {256, s.out, 1, 1});
      biased(numbered(naming_.output, {level}), {256, 256, 3, 3});
    }
  }

  void head(HeadSize size) {
    for (int i = 0; i < size.depth; ++i) {
      const int conv = i * naming_.layers_of_unit;
      const int norm = conv + naming_.norm_of_unit;
      add(numbered(naming_.kernel_conv, {conv}) + ".weight",
          {size.tower, i == 0 ? 258 : size.tower, 3, 3});
      group_norm(numbered(naming_.kernel_norm, {norm}), size.tower);
      add(numbered(naming_.category_conv, {conv}) + ".weight",
          {size.tower, i == 0 ? 256 : size.tower, 3, 3});
      group_norm(numbered(naming_.category_norm, {norm}), size.tower);
    }
    biased(naming_.categories, {kClasses, size.tower, 3, 3});
    biased(naming_.kernels, {size.kernel, size.tower, 3, 3});
    mask_features(size);
  }

  Weights weights;

 private:
  void group_norm(const std::string& name, std::int64_t channels) {
    add(name + ".weight", {channels});
    add(name + ".bias", {channels});
  }

  void mask_features(HeadSize size) {
    struct Unit {
      int level;
      int number;
      std::int64_t in;
    };
    for (const Unit& unit : {Unit{0, 0, 256},
                             {1, 0, 256},
                             {2, 0, 256},
                             {2, 1, 128},
                             {3, 0, 258},
                             {3, 1, 128},
                             {3, 2, 128}}) {
      const auto unit_number = {unit.level, unit.number};
      add(numbered(naming_.mask_conv, unit_number) + ".weight", {128, unit.in, 3, 3});
      group_norm(numbered(naming_.mask_norm, unit_number), 128);
    }
    add(naming_.mask_out_conv + ".weight", {size.kernel, 128, 1, 1});
    group_norm(naming_.mask_out_norm, size.kernel);
  }

  Naming naming_;
  float next_value_ = 1.0F;
};

/// A backbone of DetectoRS: SAC in stages 2 to 4, and the feedback connections in the second one.
void add_detectors_backbone(const std::string& prefix, bool is_second, Checkpoint& checkpoint) {
  const auto standardised = [&](const std::string& name, Shape shape) {
    const std::int64_t out = shape[0];
    checkpoint.add(name + ".weight", std::move(shape));
    checkpoint.add(name + ".weight_gamma", {out, 1, 1, 1});
    checkpoint.add(name + ".weight_beta", {out, 1, 1, 1});
  };
  standardised(prefix + "conv1", {64, 3, 7, 7});
  checkpoint.norm(prefix + "bn1", 64);
  for (const Stage& s : kStages) {
    for (int b = 0; b < s.blocks; ++b) {
      const std::string block = prefix + numbered("layer%.%.", {s.number, b});
      const std::int64_t c = s.planes;
      standardised(block + "conv1", {c, b == 0 ? s.in : s.out, 1, 1});
      checkpoint.norm(block + "bn1", c);
      standardised(block + "conv2", {c, c, 3, 3});
      if (s.number > 1) {
        checkpoint.add(block + "conv2.weight_diff", {c, c, 3, 3});
        checkpoint.biased(block + "conv2.switch", {1, c, 1, 1});
        checkpoint.biased(block + "conv2.pre_context", {c, c, 1, 1});
        checkpoint.biased(block + "conv2.post_context", {c, c, 1, 1});
        checkpoint.biased(block + "conv2.offset_s", {18, c, 3, 3});
        checkpoint.biased(block + "conv2.offset_l", {18, c, 3, 3});
      }
      checkpoint.norm(block + "bn2", c);
      standardised(block + "conv3", {s.out, c, 1, 1});
      checkpoint.norm(block + "bn3", s.out);
    }
    const std::string block = prefix + numbered("layer%.0.", {s.number});
    standardised(block + "downsample.0", {s.out, s.in, 1, 1});
    checkpoint.norm(block + "downsample.1", s.out);
    if (is_second && s.number > 1) checkpoint.biased(block + "rfp_conv", {s.out, 256, 1, 1});
  }
}

}  // namespace

Naming solo_names() {
  Naming names;
  names.prefix = "state_dict.module.";
  names.category_conv = "bbox_head.cate_convs.%.conv";
  names.category_norm = "bbox_head.cate_convs.%.gn";
  names.kernel_conv = "bbox_head.kernel_convs.%.conv";
  names.kernel_norm = "bbox_head.kernel_convs.%.gn";
  names.categories = "bbox_head.solo_cate";
  names.kernels = "bbox_head.solo_kernel";
  names.mask_conv = "mask_feat_head.convs_all_levels.%.conv%.conv";
  names.mask_norm = "mask_feat_head.convs_all_levels.%.conv%.gn";
  names.mask_out_conv = "mask_feat_head.conv_pred.0.conv";
  names.mask_out_norm = "mask_feat_head.conv_pred.0.gn";
  return names;
}

Naming adelaidet_names() {
  Naming names;
  names.stem_conv = "backbone.bottom_up.stem.conv1";
  names.stem_norm = "backbone.bottom_up.stem.conv1.norm";
  names.first_stage = 2;
  names.block_conv = "backbone.bottom_up.res%.%.conv%";
  names.block_norm = "backbone.bottom_up.res%.%.conv%.norm";
  names.skip_conv = "backbone.bottom_up.res%.0.shortcut";
  names.skip_norm = "backbone.bottom_up.res%.0.shortcut.norm";
  names.first_level = 2;
  names.lateral = "backbone.fpn_lateral%";
  names.output = "backbone.fpn_output%";
  names.layers_of_unit = 3;  // convolution, norm, ReLU
  names.norm_of_unit = 1;
  names.category_conv = names.category_norm = "ins_head.cate_tower.%";
  names.kernel_conv = names.kernel_norm = "ins_head.kernel_tower.%";
  names.categories = "ins_head.cate_pred";
  names.kernels = "ins_head.kernel_pred";
  names.mask_conv = "mask_head.convs_all_levels.%.conv%.0";
  names.mask_norm = "mask_head.convs_all_levels.%.conv%.1";
  names.mask_out_conv = "mask_head.conv_pred.0";
  names.mask_out_norm = "mask_head.conv_pred.1";
  names.counters = false;
  return names;
}

Weights published_checkpoint(const Naming& naming, HeadSize head) {
  Checkpoint checkpoint(naming);
  checkpoint.backbone();
  checkpoint.neck();
  checkpoint.head(head);
  return std::move(checkpoint.weights);
}

Weights detectors_checkpoint(HeadSize head) {
  Checkpoint checkpoint(Naming{});
  add_detectors_backbone("backbone.", false, checkpoint);
  checkpoint.neck();
  add_detectors_backbone("neck.rfp_modules.0.", true, checkpoint);
  checkpoint.biased("neck.rfp_aspp.aspp.0", {64, 256, 1, 1});
  checkpoint.biased("neck.rfp_aspp.aspp.1", {64, 256, 3, 3});
  checkpoint.biased("neck.rfp_aspp.aspp.2", {64, 256, 3, 3});
  checkpoint.biased("neck.rfp_aspp.aspp.3", {64, 256, 1, 1});
  checkpoint.biased("neck.rfp_weight", {1, 256, 1, 1});
  checkpoint.head(head);
  return std::move(checkpoint.weights);
}

Weights torchvision_resnet50() {
  Naming names;
  for (std::string* name : {&names.stem_conv, &names.stem_norm, &names.block_conv,
                            &names.block_norm, &names.skip_conv, &names.skip_norm}) {
    name->erase(0, std::string("backbone.").size());
  }
  Checkpoint checkpoint(names);
  checkpoint.backbone();
  checkpoint.biased("fc", {1000, 2048});
  return std::move(checkpoint.weights);
}

}  // namespace mms::testing
