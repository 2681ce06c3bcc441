#include "mms/run/record/logged_frame.hpp"

#include <numeric>

namespace mms {

double LoggedFrame::stages_ms() const {
  return std::accumulate(stage_ms.begin(), stage_ms.end(), read_ms);
}

}  // namespace mms
