#include "apps/mms/console/progress.hpp"

#include <fmt/core.h>

#include "mms/pipeline/frame_result.hpp"

namespace mms {

void Progress::on_start(std::size_t frames) {
  total_ = frames;
  start_ = Clock::now();
}

void Progress::on_frame(const RunLog& log) {
  if (status_.due(log.frames().size() >= total_)) status_.show(line(log));
}

std::string Progress::line(const RunLog& log) const {
  const std::chrono::duration<double> elapsed = Clock::now() - start_;
  const LoggedFrame& frame = log.frames().back();
  std::string stages;
  for (std::size_t i = 0; i < kStageCount; ++i) {
    stages += fmt::format(" {} {:.1f}", to_string(static_cast<Stage>(i)), frame.stage_ms[i]);
  }
  return fmt::format("frame {}/{}  {:.1f} Hz  ms:{}  dynamic {:.0f} %  objects {}  {}",
                     log.frames().size(), total_,
                     static_cast<double>(log.frames().size()) / elapsed.count(), stages,
                     100.0 * frame.dynamic_share, log.objects_now(), to_string(frame.status));
}

}  // namespace mms
