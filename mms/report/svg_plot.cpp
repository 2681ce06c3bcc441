#include "mms/report/svg_plot.hpp"

#include <algorithm>

#include "mms/report/html.hpp"

namespace mms {
namespace {

constexpr int kColors = 8;
/// Width of a plot over the height of its text on narrow screens: 10 px at 360 px.
constexpr int kNarrowText = 36;
/// Margin between data and frame, as a share of the data's extent.
constexpr double kMargin = 0.04;
/// A line with more points is downsampled; twice what a screen can show.
constexpr std::size_t kMaxPoints = 2000;

using Values = std::vector<double>;

std::string color_class(int color) {
  return std::string(1, 'c').append(std::to_string(color % kColors));
}

/// Indices of the samples to draw: all, or the first, lowest and highest one of every run.
std::vector<std::size_t> thinned(const Values& y) {
  std::vector<std::size_t> places;
  const std::size_t run = y.size() <= kMaxPoints ? 1 : 3 * y.size() / kMaxPoints + 1;
  for (std::size_t begin = 0; begin < y.size(); begin += run) {
    const auto first = y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = y.begin() + static_cast<std::ptrdiff_t>(std::min(begin + run, y.size()));
    // NaN would violate the order that minmax requires.
    const auto less = [](double a, double b) { return plottable(a) && (!plottable(b) || a < b); };
    const auto more = [](double a, double b) { return plottable(a) && (!plottable(b) || a > b); };
    places.push_back(begin);
    places.push_back(static_cast<std::size_t>(std::min_element(first, last, less) - y.begin()));
    places.push_back(static_cast<std::size_t>(std::min_element(first, last, more) - y.begin()));
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

void add_vertex(std::string& path, char command, const SvgCanvas& canvas, double x, double y) {
  path += command;
  path += canvas.at(x, y);
}

/// Path of the line; single points become dots through the round line cap.
std::string line_path(const SvgCanvas& canvas, const Values& x, const Values& y) {
  std::string path;
  bool open = false;
  for (const std::size_t i : thinned(y)) {
    const bool shown = plottable(x[i]) && plottable(y[i]);
    if (shown) add_vertex(path, open ? 'L' : 'M', canvas, x[i], y[i]);
    if (shown && !open) path += "h0";
    open = shown;
  }
  return path;
}

/// Path of the area: along the upper boundary and back along the lower one.
std::string band_path(const SvgCanvas& canvas, const Values& x, const Values& low,
                      const Values& high) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (plottable(x[i]) && plottable(low[i]) && plottable(high[i])) places.push_back(i);
  }
  std::string path;
  for (const std::size_t i : places) {
    add_vertex(path, path.empty() ? 'M' : 'L', canvas, x[i], high[i]);
  }
  for (auto i = places.rbegin(); i != places.rend(); ++i) {
    add_vertex(path, 'L', canvas, x[*i], low[*i]);
  }
  if (!path.empty()) path += 'Z';
  return path;
}

}  // namespace

void SvgPlot::add_line(const std::string& name, int color, const Values& x, const Values& y) {
  series_.push_back({Kind::kLine, name, color, x, {}, y});
}

void SvgPlot::add_band(const std::string& name, int color, const Values& x, const Values& low,
                       const Values& high) {
  series_.push_back({Kind::kBand, name, color, x, low, high});
}

void SvgPlot::add_marker(const std::string& name, int color, double x, double y) {
  series_.push_back({Kind::kMarker, name, color, {x}, {}, {y}});
}

std::optional<SvgCanvas> SvgPlot::canvas() const {
  std::vector<Values> xs;
  std::vector<Values> ys;
  for (const Series& series : series_) {
    xs.push_back(series.x);
    ys.push_back(series.y);
    if (series.kind == Kind::kBand) ys.push_back(series.low);
  }
  std::optional<AxisRange> x = range_of(xs, layout_.equal_aspect ? kMargin : 0.0);
  std::optional<AxisRange> y = range_of(ys, kMargin);
  if (!x || !y) return std::nullopt;
  x = x->widened_to(layout_.min_extent);
  y = y->widened_to(layout_.min_extent);
  if (layout_.y_from_zero) y = AxisRange{0.0, std::max(y->max, 1e-6)};
  SvgCanvas canvas(layout_.width, layout_.height, *x, *y);
  if (layout_.equal_aspect) canvas.make_equal_aspect();
  return canvas;
}

std::string SvgPlot::draw(const Series& series, const SvgCanvas& canvas) {
  const std::string color = color_class(series.color);
  if (series.kind == Kind::kMarker) {
    if (!plottable(series.x[0]) || !plottable(series.y[0])) return "";
    return "<path class=\"marker " + color + "\" d=\"M" + canvas.at(series.x[0], series.y[0]) +
           "h0\"/>";
  }
  const bool band = series.kind == Kind::kBand;
  const std::string path = band ? band_path(canvas, series.x, series.low, series.y)
                                : line_path(canvas, series.x, series.y);
  return "<path class=\"" + std::string(band ? "band " : "line ") + color + "\" d=\"" + path +
         "\"/>";
}

std::string SvgPlot::legend() const {
  if (series_.size() < 2) return "";
  std::string html = "<div class=\"legend\">";
  for (const Series& series : series_) {
    html += "<span><i class=\"swatch " + color_class(series.color) + "\"></i>" +
            escape_html(series.name) + "</span>";
  }
  return html + "</div>";
}

std::string SvgPlot::render() const {
  const std::optional<SvgCanvas> area = canvas();
  if (!area) return "<p class=\"note\">no data</p>";
  const std::string width = std::to_string(layout_.width);
  const std::string height = std::to_string(layout_.height);
  const std::string narrow = std::to_string(layout_.width / kNarrowText);
  std::string svg = legend() + "<svg class=\"plot\" role=\"img\" aria-label=\"" +
                    escape_html(layout_.title) + "\" style=\"--narrow:" + narrow +
                    "px\" viewBox=\"0 0 " + width + " " + height + "\">";
  svg += area->axes(layout_.x_label, layout_.y_label);
  for (const Series& series : series_) svg += draw(series, *area);
  return svg + "</svg>";
}

}  // namespace mms
