#include "mms/pipeline/async_pipeline.hpp"

#include <tbb/global_control.h>

#include <chrono>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "mms/core/bounded_queue.hpp"

namespace mms {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kQueueCapacity = 3;

struct Input {
  Frame frame;
  double read_ms = 0.0;
};

struct Perceived {
  Input input;
  Perception perception;
};

std::optional<Input> read(const AsyncPipeline::Source& source) {
  const Clock::time_point start = Clock::now();
  std::optional<Frame> frame = source();
  if (!frame) return std::nullopt;
  const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
  return Input{std::move(*frame), elapsed.count()};
}

/// Lets time pass until a frame would have come from the sensor.
class Pace {
 public:
  void wait_for(Timestamp stamp) {
    if (!first_) {
      first_ = stamp;
      start_ = Clock::now();
    }
    std::this_thread::sleep_until(start_ + (stamp - *first_));
  }

 private:
  std::optional<Timestamp> first_;
  Clock::time_point start_;
};

/// The first exception any of several threads threw.
class FirstError {
 public:
  void keep_current() {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
};

}  // namespace

void AsyncPipeline::run(SlamSystem& system, const Source& source, const Sink& sink) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(options_.threads));
  if (options_.threads == 1 && !options_.realtime) {
    run_serial(system, source, sink);
  } else {
    run_threaded(system, source, sink);
  }
}

void AsyncPipeline::run_serial(SlamSystem& system, const Source& source, const Sink& sink) {
  while (std::optional<Input> input = read(source)) {
    FrameResult result = system.process(input->frame);
    sink({std::move(input->frame), std::move(result), input->read_ms});
  }
}

void AsyncPipeline::run_threaded(SlamSystem& system, const Source& source, const Sink& sink) {
  BoundedQueue<Input> inputs(kQueueCapacity);
  BoundedQueue<Perceived> perceived(kQueueCapacity);
  FirstError error;
  const auto guarded = [&](const auto& work) {
    try {
      work();
    } catch (...) {
      error.keep_current();
      inputs.close();
      perceived.close();
    }
  };

  std::thread reader([&] {
    guarded([&] {
      Pace pace;
      while (std::optional<Input> input = read(source)) {
        if (options_.realtime) {
          pace.wait_for(input->frame.stamp);
          if (!inputs.try_push(std::move(*input))) ++dropped_;
        } else if (!inputs.push(std::move(*input))) {
          break;
        }
      }
      inputs.close();
    });
  });
  std::thread perceiver([&] {
    guarded([&] {
      while (std::optional<Input> input = inputs.pop()) {
        Perception perception = system.perceive(input->frame);
        if (!perceived.push({std::move(*input), std::move(perception)})) break;
      }
      perceived.close();
    });
  });
  guarded([&] {
    while (std::optional<Perceived> item = perceived.pop()) {
      FrameResult result = system.localize(std::move(item->perception));
      sink({std::move(item->input.frame), std::move(result), item->input.read_ms});
    }
  });
  reader.join();
  perceiver.join();
  error.rethrow();
}

}  // namespace mms
