#pragma once

#include <torch/types.h>

#include <vector>

#include "mms/segmentation/network/solo_head.hpp"
#include "mms/training/data/target_assignment.hpp"

namespace mms {

/// 1 - 2 |p q| / (|p|^2 + |q|^2) of each row; both (n, pixels) in [0, 1].
torch::Tensor dice_loss(const torch::Tensor& probability, const torch::Tensor& target);

/// Sigmoid focal loss with alpha 0.25 and gamma 2 of every element.
/// @param target  0 or 1, of the logits' shape
torch::Tensor focal_loss(const torch::Tensor& logits, const torch::Tensor& target);

/// Unweighted parts of SOLOv2's loss for a batch.
struct SoloLoss {
  torch::Tensor category;  ///< focal loss, summed over the cells, divided by the number of positive
                           ///< ones plus 1
  torch::Tensor mask;      ///< dice loss, mean over the pairs of cell and object
};

/// @param targets  one per image
SoloLoss solo_loss(const network::HeadOutput& output, const std::vector<ImageTargets>& targets);

}  // namespace mms
