#pragma once

#include <torch/optim/optimizer.h>

#include <filesystem>
#include <memory>

#include "mms/segmentation/network/solo_network.hpp"
#include "mms/training/data/batch.hpp"
#include "mms/training/data/training_config.hpp"

namespace mms {

/// What one step did.
struct StepResult {
  double loss = 0.0;  ///< the weighted sum
  double category_loss = 0.0;
  double mask_loss = 0.0;
};

/// A network being trained: its weights, their running average, the optimizer's memory.
class Trainer {
 public:
  /// On the GPU where there is one and the config allows it.
  explicit Trainer(const TrainingConfig& config);

  /// Fills the network with weights that it starts from; those it lacks keep their random values.
  void initialise(const Weights& weights, const std::string& where);

  /// One step of the optimizer. @throws DataError when the loss is not finite.
  StepResult step(const Batch& batch);

  int steps() const { return steps_; }  ///< done so far

  /// The averaged network, in evaluation mode.
  network::SoloNetwork& average() { return average_; }

  /// Writes everything that `load` needs to go on as if nothing had happened. @throws FileError
  void save(const std::filesystem::path& path);

  /// @throws DataError when the file is no checkpoint of this network.
  void load(const std::filesystem::path& path);

 private:
  void update_average();

  TrainingConfig config_;
  torch::Device device_;
  network::SoloNetwork network_;
  network::SoloNetwork average_;
  std::unique_ptr<torch::optim::Optimizer> optimizer_;
  int steps_ = 0;
};

}  // namespace mms
