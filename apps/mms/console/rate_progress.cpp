#include "apps/mms/console/rate_progress.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mms {

double RateProgress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void RateProgress::show(int done, int total, int fresh, const std::string& note) {
  if (!status_.due(done >= total)) return;
  const double rate = std::max(fresh, 1) / std::max(seconds(), 1e-9);
  status_.show(fmt::format("{} {}/{}  {:.1f}/s  {:.0f} s left{}", what_, done, total, rate,
                           (total - done) / rate, note.empty() ? "" : "  " + note));
}

}  // namespace mms
