#include "apps/mms/console/rate_progress.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "apps/mms/console/duration_text.hpp"

namespace mms {

double RateProgress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void RateProgress::show(int done, int total, int fresh, const std::string& note) {
  if (!status_.due(done >= total)) return;
  const double rate = std::max(fresh, 1) / std::max(seconds(), 1e-9);
  status_.show(fmt::format("{} {}/{}  {:.1f}/s  {} left{}", what_, done, total, rate,
                           duration_text((total - done) / rate), note.empty() ? "" : "  " + note));
}

}  // namespace mms
