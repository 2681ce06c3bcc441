#include <cmath>
#include <map>

#include "mms/io/text/atomic_file.hpp"
#include "mms/report/html.hpp"
#include "mms/report/report_style.hpp"
#include "mms/report/svg_plot.hpp"
#include "mms/training/run/training_log.hpp"

namespace mms {
namespace {

using Column = std::vector<double>;

Column column(const std::vector<LossPoint>& points, double LossPoint::*member) {
  Column values;
  for (const LossPoint& point : points) values.push_back(point.*member);
  return values;
}

Column images_of(const std::vector<LossPoint>& points) {
  Column values;
  for (const LossPoint& point : points) values.push_back(point.images);
  return values;
}

std::string loss_plot(const std::vector<LossPoint>& points) {
  SvgPlot plot({.title = "losses", .x_label = "images", .y_label = "loss", .y_from_zero = true});
  const Column images = images_of(points);
  plot.add_line("total", 0, images, column(points, &LossPoint::loss));
  plot.add_line("category (focal)", 1, images, column(points, &LossPoint::category_loss));
  plot.add_line("mask (dice)", 2, images, column(points, &LossPoint::mask_loss));
  return plot.render();
}

std::string rate_plot(const std::vector<LossPoint>& points) {
  SvgPlot plot({.title = "learning rate",
                .x_label = "images",
                .y_label = "learning rate",
                .height = 180,
                .y_from_zero = true});
  plot.add_line("learning rate", 3, images_of(points), column(points, &LossPoint::learning_rate));
  return plot.render();
}

std::string ap_plot(const std::vector<ApPoint>& points, double ApPoint::*member,
                    const std::string& label) {
  std::map<std::string, std::pair<Column, Column>> curves;
  for (const ApPoint& point : points) {
    if (std::isnan(point.*member)) continue;
    auto& [images, values] = curves[point.category + ", " + point.set];
    images.push_back(point.images);
    values.push_back(point.*member);
  }
  SvgPlot plot({.title = label, .x_label = "images", .y_label = label, .y_from_zero = true});
  int color = 0;
  for (const auto& [name, curve] : curves) plot.add_line(name, color++, curve.first, curve.second);
  return plot.render();
}

std::string section(const std::string& title, const std::string& content) {
  return "<section><h2>" + title + "</h2>" + content + "</section>";
}

}  // namespace

void write_training_report(const std::filesystem::path& path, const std::string& name,
                           const TrainingLog& log, const std::string& config) {
  const int images = log.losses.empty() ? 0 : log.losses.back().images;
  const auto minutes = static_cast<int>(std::lround(log.seconds / 60.0));
  const std::string title = escape_html(name);
  std::string page = "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     title + "</title><style>" + std::string(kReportStyle) +
                     "</style></head><body><h1>" + title + "</h1><p class=\"note\">" +
                     std::to_string(images) + " images in " + std::to_string(minutes) +
                     " minutes</p>";
  page += section("Losses", loss_plot(log.losses));
  page += section("Mask AP, averaged weights", ap_plot(log.aps, &ApPoint::ap, "AP"));
  page += section("Mask AP50, averaged weights", ap_plot(log.aps, &ApPoint::ap50, "AP50"));
  page += section("Learning rate", rate_plot(log.losses));
  page += section("Config", "<pre>" + escape_html(config) + "</pre>");
  page += "</body></html>\n";
  write_file(path, page);
}

}  // namespace mms
