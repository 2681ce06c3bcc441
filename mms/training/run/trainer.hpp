#pragma once

#include <torch/optim/optimizer.h>

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>

#include "mms/segmentation/network/solo_network.hpp"
#include "mms/training/data/batch.hpp"
#include "mms/training/data/training_config.hpp"
#include "mms/training/processes/process_group.hpp"

namespace mms {

/// A network in training: weights, their moving average, state of the optimizer. With several
/// processes each has a copy, and all copies do the same steps.
class Trainer {
 public:
  /// Uses a GPU if available and enabled.
  /// @param group  lives longer than this
  Trainer(const TrainingConfig& config, ProcessGroup& group);

  /// Sets initial weights; missing ones keep their random values.
  void initialise(const Weights& weights, const std::string& where);

  /// One step of the optimizer, together with all processes.
  /// @param batch  the part of this process
  /// @returns (3) the weighted sum of the losses, the category loss and the mask loss, on the
  /// device: reading it waits for a GPU. The sum over the processes is that of the batch.
  torch::Tensor step(const Batch& batch);

  int steps() const { return steps_; }  ///< done so far

  /// The averaged network, in evaluation mode.
  network::SoloNetwork& average() { return average_; }

  /// Writes the complete state for `load`.
  /// @throws FileError
  void save(const std::filesystem::path& path);

  /// @throws DataError if the file is not a checkpoint of this network.
  void load(const std::filesystem::path& path);

  /// Gives all processes the complete state of the first one.
  void share_state();

 private:
  void write(std::ostream& stream);
  void read(std::istream& stream, const std::string& where);
  void add_gradients();
  void clip_gradients();
  void update_average();

  TrainingConfig config_;
  ProcessGroup& group_;
  torch::Device device_;
  network::SoloNetwork network_;
  network::SoloNetwork average_;
  std::unique_ptr<torch::optim::Optimizer> optimizer_;
  int steps_ = 0;
};

}  // namespace mms
