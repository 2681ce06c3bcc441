#pragma once

#include <string>

#include "mms/report/report.hpp"

namespace mms {

/// Colored strip of the frames' statuses over time, aligned with the time axes of the plots, and a
/// legend with the number of frames per status. Where frames share a pixel, the worst is shown.
std::string status_strip(const RunReport& report);

}  // namespace mms
