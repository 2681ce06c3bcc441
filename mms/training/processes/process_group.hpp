#pragma once

#include <torch/types.h>

#include <functional>
#include <memory>
#include <string>

#include "mms/segmentation/network/batch_norm.hpp"
#include "mms/training/processes/process_place.hpp"

namespace mms {

/// The processes of a training that divide its batches (data parallel), connected by Gloo. All call
/// the same functions in the same order; each call waits for all. One process alone needs no Gloo.
class ProcessGroup {
 public:
  /// One process alone.
  ProcessGroup();
  /// Waits until all have started.
  /// @param stop  asked several times a second; true ends the wait by an Error
  /// @throws ConfigError if this build has no Gloo; Error if the others cannot be reached
  explicit ProcessGroup(const ProcessPlace& place, const std::function<bool()>& stop = {});
  ~ProcessGroup();
  ProcessGroup(const ProcessGroup&) = delete;
  ProcessGroup& operator=(const ProcessGroup&) = delete;

  const ProcessPlace& place() const { return place_; }
  int size() const { return place_.size; }
  /// Whether this is the process that writes files.
  bool is_first() const { return place_.rank == 0; }

  /// The sum over all processes: the same bits in each, of the tensor's shape, type and device.
  /// @throws Error if another process has ended
  torch::Tensor sum(const torch::Tensor& values);

  /// `sum` as a function; empty for one process.
  network::ProcessSum as_sum();

  /// The bytes of the first process. @throws Error as `sum`
  std::string broadcast(const std::string& bytes);

 private:
  struct Connection;

  ProcessPlace place_;
  std::unique_ptr<Connection> connection_;
};

}  // namespace mms
