#pragma once

#include <sys/resource.h>

namespace mms {

/// Peak memory of the process [MiB].
inline double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // Linux reports KiB
}

}  // namespace mms
