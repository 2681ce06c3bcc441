#pragma once

#include <torch/types.h>

#include <vector>

#include "mms/training/data/sample_store.hpp"
#include "mms/training/data/target_assignment.hpp"

namespace mms {

/// Images with their targets.
struct Batch {
  torch::Tensor images;  ///< (B, 3, H, W) float32, normalized; on the CPU
  std::vector<ImageTargets> targets;
};

/// Whether a GPU is available and enabled.
bool uses_cuda(const TrainingConfig& config);

/// The images of each batch that a process has: the part of this number out of `parts` equal ones.
struct BatchPart {
  int number = 0;  ///< from 0
  int parts = 1;   ///< a divisor of the batch's size
};

/// Draws, augments and annotates the images of one step. Determined by the number; the parts
/// together are the same images for any number of parts.
Batch make_batch(const SampleStore& store, const TrainingConfig& config, int number,
                 const BatchPart& part = {});

}  // namespace mms
