#include "mms/report/report.hpp"

#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/report/html.hpp"
#include "mms/report/report_plots.hpp"
#include "mms/report/report_style.hpp"
#include "mms/report/status_strip.hpp"

namespace mms {
namespace {

std::string section(const std::string& title, const std::string& content) {
  return "<section><h2>" + escape_html(title) + "</h2>" + content + "</section>\n";
}

std::string subtitle(const RunReport& report) {
  if (report.frames.empty()) return "no frames were processed";
  const Duration length = report.frames.back().stamp - report.frames.front().stamp;
  return std::to_string(report.frames.size()) +
         (report.frames.size() == 1 ? " frame over " : " frames over ") +
         to_fixed(to_seconds(length), 1) + " s, stamps from " +
         report.frames.front().stamp.to_string() + " s";
}

std::string summary_table(const std::vector<MetricSection>& summary) {
  if (summary.empty()) return "<p class=\"note\">no data</p>";
  std::string rows;
  for (const MetricSection& group : summary) {
    rows += "<tr class=\"group\"><th scope=\"rowgroup\">" + escape_html(group.title) + "</th><td>" +
            escape_html(group.rating) + "</td></tr>";
    for (const MetricValue& item : group.values) {
      rows += "<tr><th scope=\"row\">" + escape_html(item.meaning) + "</th><td>" +
              escape_html(with_unit(item)) + "</td></tr>";
    }
  }
  return "<table><tbody>" + rows + "</tbody></table>";
}

/// Closed loops, and why others were rejected.
std::string loops_note(const ReportLoops& loops) {
  if (loops.closed.empty() && loops.rejected.empty() && loops.to_earlier_map == 0) return "";
  std::string reasons;
  for (const auto& [reason, count] : loops.rejected) {
    reasons += (reasons.empty() ? " Rejected: " : ", ") + std::to_string(count) + " " + reason;
  }
  if (!reasons.empty()) reasons += ".";
  const std::string to_map =
      loops.to_earlier_map > 0 ? ", " + std::to_string(loops.to_earlier_map) + " to the map" : "";
  return "<p class=\"note\">" + std::to_string(loops.closed.size()) +
         (loops.closed.size() == 1 ? " loop" : " loops") + to_map + "." + escape_html(reasons) +
         "</p>";
}

std::string list_of(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string items;
  for (const std::string& line : lines) items += "<li>" + escape_html(line) + "</li>";
  return "<h3>" + escape_html(title) + "</h3><ul>" + items + "</ul>";
}

std::string run_section(const RunReport& report) {
  if (report.version.empty()) return "";
  const std::string settings = report.settings.empty()
                                   ? "<p>All settings have their defaults.</p>"
                                   : list_of("Settings other than the defaults", report.settings);
  return section("Run", "<p>mms " + escape_html(report.version) + "</p>" + settings +
                            list_of("Warnings", report.warnings));
}

std::string image_element(const std::string& title, const Image<Rgb>& image,
                          const std::string& type, const std::vector<std::uint8_t>& bytes) {
  return "<img alt=\"" + escape_html(title) + "\" width=\"" + std::to_string(image.width()) +
         "\" height=\"" + std::to_string(image.height()) + "\" src=\"data:image/" + type +
         ";base64," + base64(bytes) + "\">";
}

std::string map_section(const std::string& title, const Image<Rgb>& view) {
  if (view.empty()) return section(title, "<p class=\"note\">no data</p>");
  return section(title, image_element(title, view, "png", encode_png(view)));
}

std::string picture_section(const std::vector<ReportPicture>& pictures) {
  std::string figures;
  for (const ReportPicture& picture : pictures) {
    if (picture.image.empty()) continue;
    figures += "<figure>" +
               image_element(picture.title, picture.image, "jpeg", encode_jpeg(picture.image)) +
               "<figcaption>" + escape_html(picture.title) + "</figcaption></figure>";
  }
  if (figures.empty()) return "";
  return section("Frames", "<div class=\"pictures\">" + figures + "</div>");
}

}  // namespace

std::string report_html(const RunReport& report) {
  const std::string name = escape_html(report.name);
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>" +
      name + "</title><style>";
  page += kReportStyle;
  page += "</style></head><body>\n<h1>" + name + "</h1><p class=\"sub\">" +
          escape_html(subtitle(report)) + "</p>\n";
  page += section("Summary", summary_table(report.summary));
  page += "<div class=\"pair\">" +
          section("Trajectory, top view", trajectory_plot(report) + loops_note(report.loops)) +
          map_section("Static map, top view", report.map_view) + "</div>\n";
  if (!report.objects_view.empty()) {
    page += map_section("Object trajectories and last positions", report.objects_view);
  }
  page += section(error_plot_title(report), error_plot(report));
  page += section("Time per stage", stage_plot(report));
  page += section("Dynamic share of the points", share_plot(report));
  page += section("Status", status_strip(report));
  page += picture_section(report.pictures);
  page += run_section(report);
  return page + "</body></html>\n";
}

void write_report_html(const std::filesystem::path& path, const RunReport& report) {
  write_file(path, report_html(report));
}

}  // namespace mms
