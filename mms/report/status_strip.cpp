#include "mms/report/status_strip.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "mms/report/svg_canvas.hpp"

namespace mms {
namespace {

constexpr int kWidth = 900;
constexpr int kHeight = 26;
constexpr int kColumns = kWidth - SvgCanvas::kLeft - SvgCanvas::kRight;

using Columns = std::vector<std::optional<Status>>;

int severity(Status status) {
  constexpr std::array<int, kStatusCount> kSeverity = {1, 0, 3, 4, 2};
  return kSeverity[static_cast<std::size_t>(status)];
}

/// Worst status in every pixel column; columns between two frames show the earlier one.
Columns columns_of(const std::vector<ReportFrame>& frames) {
  Columns columns(kColumns);
  const double length = to_seconds(frames.back().stamp - frames.front().stamp);
  for (const ReportFrame& frame : frames) {
    const double place =
        length > 0.0 ? to_seconds(frame.stamp - frames.front().stamp) / length : 0.0;
    const auto column = static_cast<std::size_t>(std::clamp(place, 0.0, 1.0) * (kColumns - 1));
    std::optional<Status>& shown = columns[column];
    if (!shown || severity(frame.status) > severity(*shown)) shown = frame.status;
  }
  for (std::size_t i = 1; i < columns.size(); ++i) {
    if (!columns[i]) columns[i] = columns[i - 1];
  }
  return columns;
}

std::string bar(std::size_t begin, std::size_t end, Status status) {
  const std::string name(to_string(status));
  return "<rect class=\"" + name + "\" x=\"" +
         std::to_string(SvgCanvas::kLeft + static_cast<int>(begin)) + "\" y=\"2\" width=\"" +
         std::to_string(end - begin) + "\" height=\"22\"><title>" + name + "</title></rect>";
}

std::string legend(const std::vector<ReportFrame>& frames) {
  std::string html = "<div class=\"legend\">";
  for (int i = 0; i < kStatusCount; ++i) {
    const auto status = static_cast<Status>(i);
    const auto count = std::count_if(frames.begin(), frames.end(), [&](const ReportFrame& frame) {
      return frame.status == status;
    });
    if (count == 0) continue;
    const std::string name(to_string(status));
    html += "<span><i class=\"swatch " + name;
    html += "\"></i>" + name + ": " + std::to_string(count) + "</span>";
  }
  return html + "</div>";
}

}  // namespace

std::string status_strip(const RunReport& report) {
  if (report.frames.empty()) return "<p class=\"note\">no data</p>";
  const Columns columns = columns_of(report.frames);
  std::string svg =
      legend(report.frames) +
      "<svg class=\"plot\" role=\"img\" aria-label=\"status over time\" viewBox=\"0 0 " +
      std::to_string(kWidth) + " " + std::to_string(kHeight) + "\">";
  for (std::size_t begin = 0; begin < columns.size();) {
    std::size_t end = begin;
    while (end < columns.size() && columns[end] == columns[begin]) ++end;
    if (columns[begin]) svg += bar(begin, end, *columns[begin]);
    begin = end;
  }
  return svg + "</svg>";
}

}  // namespace mms
