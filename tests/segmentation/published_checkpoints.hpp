#pragma once

#include <string>

#include "mms/core/weights.hpp"

namespace mms::testing {

/// Names of a framework for the tensors of SOLOv2 with a ResNet-50, taken from its source; by
/// default MMDetection. Names end before ".weight", ".bias", ...; each % is a number.
struct Naming {
  std::string prefix;  ///< of the whole checkpoint
  std::string stem_conv = "backbone.conv1";
  std::string stem_norm = "backbone.bn1";
  int first_stage = 1;
  std::string block_conv = "backbone.layer%.%.conv%";  ///< stage, block, convolution
  std::string block_norm = "backbone.layer%.%.bn%";
  std::string skip_conv = "backbone.layer%.0.downsample.0";
  std::string skip_norm = "backbone.layer%.0.downsample.1";
  int first_level = 0;
  std::string lateral = "neck.lateral_convs.%.conv";
  std::string output = "neck.fpn_convs.%.conv";
  int layers_of_unit = 1;  ///< difference between the numbers of a tower's units
  int norm_of_unit = 0;    ///< offset of a unit's norm from its convolution
  std::string category_conv = "mask_head.cls_convs.%.conv";
  std::string category_norm = "mask_head.cls_convs.%.gn";
  std::string kernel_conv = "mask_head.kernel_convs.%.conv";
  std::string kernel_norm = "mask_head.kernel_convs.%.gn";
  std::string categories = "mask_head.conv_cls";
  std::string kernels = "mask_head.conv_kernel";
  std::string mask_conv = "mask_head.mask_feature_head.convs_all_levels.%.conv%.conv";
  std::string mask_norm = "mask_head.mask_feature_head.convs_all_levels.%.conv%.gn";
  std::string mask_out_conv = "mask_head.mask_feature_head.conv_pred.conv";
  std::string mask_out_norm = "mask_head.mask_feature_head.conv_pred.gn";
  bool counters = true;  ///< batch norm has num_batches_tracked
};

Naming solo_names();       ///< WXinlong/SOLO
Naming adelaidet_names();  ///< on detectron2

/// Widths of the heads.
struct HeadSize {
  int tower = 512;
  int depth = 4;
  int kernel = 256;
};
inline constexpr HeadSize kFullHead = {512, 4, 256};
inline constexpr HeadSize kLightHead = {256, 2, 128};

/// A checkpoint of SOLOv2 with a ResNet-50 for COCO. Each tensor is filled with one number, which
/// does not depend on the naming.
Weights published_checkpoint(const Naming& naming, HeadSize head);

/// The same of MMDetection's DetectoRS: SAC in the backbone and RFP.
Weights detectors_checkpoint(HeadSize head);

/// A ResNet-50 of torchvision, with its classifier.
Weights torchvision_resnet50();

}  // namespace mms::testing
