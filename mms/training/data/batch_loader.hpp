#pragma once

#include <exception>
#include <thread>

#include "mms/core/bounded_queue.hpp"
#include "mms/training/data/batch.hpp"

namespace mms {

/// Prepares batches in a separate thread, a few ahead of the training.
class BatchLoader {
 public:
  /// @param first, end numbers of the batches, [first, end)
  /// @param part       what to prepare of each
  BatchLoader(const SampleStore& store, const TrainingConfig& config, int first, int end,
              const BatchPart& part = {});
  ~BatchLoader();
  BatchLoader(const BatchLoader&) = delete;
  BatchLoader& operator=(const BatchLoader&) = delete;

  /// The next batch; nullopt after the last one. Rethrows exceptions of the thread.
  std::optional<Batch> next();

 private:
  void prepare(const SampleStore& store, const TrainingConfig& config, int first, int end,
               const BatchPart& part);

  BoundedQueue<Batch> queue_;
  std::exception_ptr fault_;
  std::thread thread_;
};

}  // namespace mms
