#pragma once

#include <sys/resource.h>

namespace mms {

/// Largest memory that the process has held so far [MiB].
inline double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux counts in KiB
}

}  // namespace mms
