#pragma once

#include <torch/types.h>

#include <vector>

#include "mms/segmentation/network/batch_norm.hpp"
#include "mms/segmentation/network/solo_head.hpp"
#include "mms/training/data/target_assignment.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// 1 - 2 |p q| / (|p|^2 + |q|^2) of each row; both (n, pixels) in [0, 1].
torch::Tensor dice_loss(const torch::Tensor& probability, const torch::Tensor& target);

/// Sigmoid focal loss with alpha 0.25 and gamma 2 of every element.
/// @param target  0 or 1, of the logits' shape
torch::Tensor focal_loss(const torch::Tensor& logits, const torch::Tensor& target);

/// Loss of the masks of objects of which only the box is known: projection and pairwise color terms
/// of BoxInst (Tian et al., CVPR 2021).
/// @param probability, box  (objects, height, width), the box in {0, 1}
/// @param images            (B, 3, height, width), normalized
/// @param image_of          index of each object's image
/// @returns (objects)
torch::Tensor box_loss(const torch::Tensor& probability, const torch::Tensor& box,
                       const torch::Tensor& images, const std::vector<std::int64_t>& image_of);

/// Unweighted parts of SOLOv2's loss for a batch, or for the part of it that a process has: the
/// parts of all processes add up to the loss of the batch.
struct SoloLoss {
  torch::Tensor category;  ///< focal loss, summed over the cells, divided by the number of positive
                           ///< ones plus 1
  torch::Tensor mask;      ///< dice loss, or `box_loss`, mean over the pairs of cell and object
};

/// @param targets  one per image
/// @param images   (B, 3, height, width), normalized, on the device of the output
/// @param sum      counts cells and pairs of all processes; empty: of this process alone
/// @param mask_pairs  largest number of pairs per image, evenly chosen; bounds memory for crowds
SoloLoss solo_loss(const network::HeadOutput& output, const std::vector<ImageTargets>& targets,
                   const torch::Tensor& images, const network::ProcessSum& sum = {},
                   int mask_pairs = ScheduleConfig{}.mask_pairs);

}  // namespace mms
