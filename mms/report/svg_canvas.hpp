#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mms/report/plot_axis.hpp"

namespace mms {

/// The drawing area of an SVG plot: maps values to pixels and writes elements.
class SvgCanvas {
 public:
  SvgCanvas(int width, int height, const AxisRange& x, const AxisRange& y);

  /// Extends the range of one axis until both axes have equal scale.
  void make_equal_aspect();

  /// Margins of the drawing area [px].
  static constexpr int kLeft = 92;
  static constexpr int kRight = 16;

  double left() const { return kLeft; }
  double right() const { return width_ - kRight; }
  double top() const { return kTop; }
  double bottom() const { return height_ - kBottom; }

  /// "x,y" [px]
  std::string at(double x, double y) const;

  /// Frame, grid, tick labels and axis labels (plain text, escaped here).
  std::string axes(std::string_view x_label, std::string_view y_label) const;

  /// @param name  class of the element; empty for none
  static std::string text(double x, double y, std::string_view anchor, std::string_view content,
                          std::string_view name = "");

 private:
  static constexpr double kTop = 10.0;
  static constexpr double kBottom = 58.0;

  double pixel_x(double value) const;
  double pixel_y(double value) const;

  double width_;
  double height_;
  AxisRange x_;
  AxisRange y_;
  bool equal_aspect_ = false;
};

/// Formats a pixel coordinate with one decimal.
std::string px(double value);

}  // namespace mms
