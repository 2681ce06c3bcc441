#include "mms/report/svg_canvas.hpp"

#include <algorithm>

#include "mms/evaluation/scores/metric_value.hpp"
#include "mms/report/html.hpp"

namespace mms {
namespace {

/// Desired distance between adjacent ticks [px].
constexpr double kTickSpacingX = 80.0;
constexpr double kTickSpacingY = 36.0;

std::string grid_line(double x1, double y1, double x2, double y2) {
  return "<path class=\"grid\" d=\"M" + px(x1) + "," + px(y1) + "L" + px(x2) + "," + px(y2) +
         "\"/>";
}

/// Every second label is left out on narrow screens, where the text is larger.
std::string_view kind_of(std::size_t tick) {
  return tick % 2 == 1 ? "second" : "";
}

void widen(AxisRange& range, double length) {
  const double margin = 0.5 * (length - range.length());
  range = {range.min - margin, range.max + margin};
}

}  // namespace

std::string px(double value) {
  return to_fixed(value, 1);
}

SvgCanvas::SvgCanvas(int width, int height, const AxisRange& x, const AxisRange& y)
    : width_(width), height_(height), x_(x), y_(y) {}

void SvgCanvas::make_equal_aspect() {
  const double unit = std::max(x_.length() / (right() - left()), y_.length() / (bottom() - top()));
  widen(x_, unit * (right() - left()));
  widen(y_, unit * (bottom() - top()));
  equal_aspect_ = true;
}

double SvgCanvas::pixel_x(double value) const {
  return left() + (value - x_.min) / x_.length() * (right() - left());
}

double SvgCanvas::pixel_y(double value) const {
  return bottom() - (value - y_.min) / y_.length() * (bottom() - top());
}

std::string SvgCanvas::at(double x, double y) const {
  return px(pixel_x(x)) + "," + px(pixel_y(y));
}

std::string SvgCanvas::text(double x, double y, std::string_view anchor, std::string_view content,
                            std::string_view name) {
  const std::string kind = name.empty() ? "" : " class=\"" + std::string(name) + "\"";
  return "<text" + kind + " x=\"" + px(x) + "\" y=\"" + px(y) + "\" text-anchor=\"" +
         std::string(anchor) + "\">" + escape_html(content) + "</text>";
}

std::string SvgCanvas::axes(std::string_view x_label, std::string_view y_label) const {
  std::string svg;
  const double x_unit = x_.length() / (right() - left());
  const double y_unit = y_.length() / (bottom() - top());
  const auto x_ticks = ticks(x_, kTickSpacingX * x_unit);
  for (std::size_t i = 0; i < x_ticks.size(); ++i) {
    const double x = pixel_x(x_ticks[i]);
    svg += grid_line(x, top(), x, bottom());
    svg += text(x, bottom() + 22.0, "middle", tick_label(x_ticks[i], x_ticks), kind_of(i));
  }
  const auto y_ticks = ticks(y_, (equal_aspect_ ? kTickSpacingX : kTickSpacingY) * y_unit);
  for (std::size_t i = 0; i < y_ticks.size(); ++i) {
    const double y = pixel_y(y_ticks[i]);
    svg += grid_line(left(), y, right(), y);
    svg += text(left() - 6.0, y + 4.0, "end", tick_label(y_ticks[i], y_ticks), kind_of(i));
  }
  svg += text(0.5 * (left() + right()), height_ - 8.0, "middle", x_label);
  const std::string centre = px(0.5 * (top() + bottom()));
  return svg + "<g transform=\"translate(18 " + centre + ") rotate(-90)\">" +
         text(0.0, 0.0, "middle", y_label) + "</g>";
}

}  // namespace mms
