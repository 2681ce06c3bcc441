#pragma once

#include <chrono>
#include <cstddef>

#include "mms/pipeline/frame_result.hpp"

namespace mms {

/// Runs one step of a frame and stores its duration in `times`. @returns what the step returns
template <class Step>
auto timed(StageTimes& times, Stage stage, const Step& step) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  auto result = step();
  const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
  times[static_cast<std::size_t>(stage)] = elapsed.count();
  return result;
}

}  // namespace mms
