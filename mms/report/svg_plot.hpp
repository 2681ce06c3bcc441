#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mms/report/svg_canvas.hpp"

namespace mms {

/// One inline SVG plot: axes with ticks, a grid, a legend. Colors are the classes c0..c7 of the
/// page's style sheet (report_style.hpp), so the plot follows its light or dark theme.
class SvgPlot {
 public:
  struct Layout {
    std::string title{};    ///< for screen readers
    std::string x_label{};  ///< with unit
    std::string y_label{};
    int width = 900;            ///< [px]
    int height = 300;           ///< [px]
    bool equal_aspect = false;  ///< equal scale in x and y
    bool y_from_zero = false;
    double min_extent = 0.0;  ///< smallest range of x and of y
  };

  explicit SvgPlot(Layout layout) : layout_(std::move(layout)) {}

  /// Adds a line through the points, with gaps at coordinates that are NaN, infinite or beyond 1e9.
  /// Long series are downsampled to the extremes of runs of samples, which keeps peaks.
  /// @param color  index of the color, modulo 8
  void add_line(const std::string& name, int color, const std::vector<double>& x,
                const std::vector<double>& y);

  /// Adds the area between y = low and y = high.
  void add_band(const std::string& name, int color, const std::vector<double>& x,
                const std::vector<double>& low, const std::vector<double>& high);

  /// Adds a dot, for positions such as the start.
  void add_marker(const std::string& name, int color, double x, double y);

  /// The legend, if there are two or more series, and the `svg` element; a note "no data" if
  /// nothing can be drawn.
  std::string render() const;

 private:
  enum class Kind { kLine, kBand, kMarker };
  struct Series {
    Kind kind = Kind::kLine;
    std::string name;
    int color = 0;
    std::vector<double> x;
    std::vector<double> low;  ///< kBand only
    std::vector<double> y;
  };

  std::optional<SvgCanvas> canvas() const;
  static std::string draw(const Series& series, const SvgCanvas& canvas);
  std::string legend() const;

  Layout layout_;
  std::vector<Series> series_;
};

}  // namespace mms
