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

/// Draws, augments and annotates the images of one step. Determined by the number.
Batch make_batch(const SampleStore& store, const TrainingConfig& config, int number);

}  // namespace mms
