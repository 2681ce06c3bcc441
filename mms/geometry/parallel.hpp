#pragma once

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mms/geometry/task_order.hpp"

namespace mms {

/// Runs `body(begin, end)` over [0, count) in chunks of `chunk`, in any order, on the threads of
/// the current tbb::task_arena. The chunks do not depend on the number of threads.
template <class Body>
void parallel_chunks(std::size_t count, std::size_t chunk, const Body& body) {
  const std::size_t chunks = (count + chunk - 1) / chunk;
  TaskOrder order;
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t i) {
    order.run([&] { body(i * chunk, std::min(count, (i + 1) * chunk)); });
  });
}

/// Runs tasks in any order, on the same threads.
template <class... Task>
void parallel_tasks(const Task&... task) {
  TaskOrder order;
  tbb::parallel_invoke([&] { order.run(task); }...);
}

/// Sum of `body(begin, end)` over the chunks of [0, count), added in chunk order: bitwise equal for
/// any number of threads.
template <class Sum, class Body>
Sum parallel_sum(std::size_t count, std::size_t chunk, const Sum& zero, const Body& body) {
  std::vector<Sum> parts((count + chunk - 1) / chunk, zero);
  parallel_chunks(count, chunk, [&](std::size_t begin, std::size_t end) {
    parts[begin / chunk] = body(begin, end);
  });
  Sum total = zero;
  for (const Sum& part : parts) total += part;
  return total;
}

}  // namespace mms
