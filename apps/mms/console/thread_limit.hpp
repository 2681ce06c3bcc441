#pragma once

#include <tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace mms {

/// While one lives, parallel work uses at most so many threads; 0: one a core.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) {
    if (threads > 0) {
      limit_.emplace(tbb::global_control::max_allowed_parallelism,
                     static_cast<std::size_t>(threads));
    }
  }

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace mms
