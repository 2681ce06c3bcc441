#include "apps/mms/paper/reproduction.hpp"

#include <nlohmann/json.hpp>

#include "mms/io/image/image_io.hpp"
#include "mms/report/html.hpp"
#include "mms/report/report_style.hpp"
#include "mms/report/svg_plot.hpp"

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

std::string figure(const ReportPicture& picture) {
  return "<section><h2>" + escape_html(picture.title) + "</h2><img alt=\"" +
         escape_html(picture.title) + "\" src=\"data:image/png;base64," +
         base64(encode_png(picture.image)) + "\"></section>\n";
}

std::string paths_plot(const std::vector<NamedPath>& paths, UpAxis up) {
  if (paths.empty()) return "";
  SvgPlot plot({.title = "localization comparison",
                .x_label = "x [m]",
                .y_label = up == UpAxis::kNegativeY ? "z [m]" : "y [m]",
                .height = 560,
                .equal_aspect = true});
  const ViewAxes axes = view_axes(Viewpoint::kTop, up);
  int color = 0;
  for (const NamedPath& path : paths) {
    std::vector<double> x;
    std::vector<double> y;
    for (const StampedPose& pose : path.poses) {
      x.push_back(axes.right.dot(pose.T_world_sensor.translation()));
      y.push_back(axes.up.dot(pose.T_world_sensor.translation()));
    }
    plot.add_line(path.name, color++, x, y);
  }
  return "<section><h2>Localization comparison, top view</h2>" + plot.render() + "</section>\n";
}

}  // namespace

std::string reproduction_html(const Reproduction& found) {
  const std::string title = escape_html(found.title);
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>" +
      title + "</title><style>";
  page += kReportStyle;
  page += "</style></head><body>\n<h1>" + title + "</h1>\n";
  for (const PlainTable& table : found.tables) page += html_of(table);
  page += paths_plot(found.paths, found.up);
  for (const ReportPicture& picture : found.pictures) {
    if (!picture.image.empty()) page += figure(picture);
  }
  return page + "</body></html>\n";
}

std::string reproduction_json(const Reproduction& found) {
  Json tables = Json::array();
  for (const PlainTable& table : found.tables) {
    tables.push_back({{"title", table.title},
                      {"columns", table.columns},
                      {"rows", table.rows},
                      {"note", table.note}});
  }
  return Json{{"tables", std::move(tables)}}.dump(1) + "\n";
}

}  // namespace mms
