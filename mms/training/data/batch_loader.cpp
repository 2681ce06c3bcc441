#include "mms/training/data/batch_loader.hpp"

#include <tbb/task_arena.h>

namespace mms {
namespace {

constexpr std::size_t kQueueCapacity = 4;  // prepared batches

}  // namespace

BatchLoader::BatchLoader(const SampleStore& store, const TrainingConfig& config, int first, int end,
                         const BatchPart& part)
    : queue_(kQueueCapacity), thread_([this, &store, config, first, end, part] {
        prepare(store, config, first, end, part);
      }) {}

BatchLoader::~BatchLoader() {
  queue_.close();
  thread_.join();
}

void BatchLoader::prepare(const SampleStore& store, const TrainingConfig& config, int first,
                          int end, const BatchPart& part) {
  try {
    const int threads =
        config.loader_threads > 0 ? config.loader_threads : tbb::task_arena::automatic;
    tbb::task_arena arena(threads);
    for (int number = first; number < end; ++number) {
      if (!queue_.push(arena.execute([&] { return make_batch(store, config, number, part); })))
        return;
    }
  } catch (...) {
    fault_ = std::current_exception();
  }
  queue_.close();
}

std::optional<Batch> BatchLoader::next() {
  std::optional<Batch> batch = queue_.pop();
  if (!batch && fault_) std::rethrow_exception(fault_);
  return batch;
}

}  // namespace mms
