#pragma once

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace mms::testing {

/// During its lifetime the process gets at most 512 MiB more than it has now, so that a damaged
/// length that is believed is a test failure.
class MemoryLimit {
 public:
  MemoryLimit() {
    getrlimit(RLIMIT_DATA, &before_);
#ifndef __SANITIZE_ADDRESS__                      // which reserves terabytes
    constexpr rlim_t kMore = rlim_t{512} << 20U;  // [B]
    rlimit limited = before_;
    limited.rlim_cur = used() + kMore;
    setrlimit(RLIMIT_DATA, &limited);
#endif
  }
  ~MemoryLimit() {
    setrlimit(RLIMIT_DATA, &before_);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  /// Data of this process [B].
  static rlim_t used() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      rlim_t kib = 0;
      if (word == "VmData:" && status >> kib) return kib << 10U;
    }
    return 0;
  }

  rlimit before_{};
};

}  // namespace mms::testing
