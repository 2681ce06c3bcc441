#pragma once

#include <torch/optim/optimizer.h>

#include <filesystem>
#include <memory>

#include "mms/segmentation/network/solo_network.hpp"
#include "mms/training/data/batch.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// A network in training: weights, their moving average, state of the optimizer.
class Trainer {
 public:
  /// Uses a GPU if available and enabled.
  explicit Trainer(const TrainingConfig& config);

  /// Sets initial weights; missing ones keep their random values.
  void initialise(const Weights& weights, const std::string& where);

  /// One step of the optimizer.
  /// @returns (3) the weighted sum of the losses, the category loss and the mask loss, on the
  /// device: reading it waits for a GPU
  torch::Tensor step(const Batch& batch);

  int steps() const { return steps_; }  ///< done so far

  /// The averaged network, in evaluation mode.
  network::SoloNetwork& average() { return average_; }

  /// Writes the complete state for `load`.
  /// @throws FileError
  void save(const std::filesystem::path& path);

  /// @throws DataError if the file is not a checkpoint of this network.
  void load(const std::filesystem::path& path);

 private:
  void clip_gradients();
  void update_average();

  TrainingConfig config_;
  torch::Device device_;
  network::SoloNetwork network_;
  network::SoloNetwork average_;
  std::unique_ptr<torch::optim::Optimizer> optimizer_;
  int steps_ = 0;
};

}  // namespace mms
