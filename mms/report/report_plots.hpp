#pragma once

#include <string>

#include "mms/report/report.hpp"

namespace mms {

/// The plots of a report, each one figure of inline HTML and SVG.

/// Top view of the trajectory, with aligned ground truth if available.
std::string trajectory_plot(const RunReport& report);

/// Distance to the aligned ground truth over time; without ground truth, distance from the first
/// pose.
std::string error_plot(const RunReport& report);

/// Title of `error_plot`.
std::string error_plot_title(const RunReport& report);

/// Milliseconds per stage, stacked, and of the whole frame.
std::string stage_plot(const RunReport& report);

/// Share of dynamic points over time [%].
std::string share_plot(const RunReport& report);

}  // namespace mms
