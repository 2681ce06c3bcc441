#pragma once

#include <sys/resource.h>

namespace mms {

/// Peak memory of the process [MB, 10^6 bytes].
inline double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1.024e-3 * static_cast<double>(usage.ru_maxrss);  // Linux reports KiB
}

}  // namespace mms
