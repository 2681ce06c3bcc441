#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mms/report/svg_canvas.hpp"

namespace mms {

/// One inline SVG plot: axes with ticks, a grid, a legend. Colours are the classes c0..c7 of the
/// page's style sheet (report_style.hpp), so the plot follows its light or dark theme.
class SvgPlot {
 public:
  struct Layout {
    std::string title{};    ///< for screen readers
    std::string x_label{};  ///< with the unit
    std::string y_label{};
    int width = 900;            ///< [px]
    int height = 300;           ///< [px]
    bool equal_aspect = false;  ///< one unit is as long in x as in y
    bool y_from_zero = false;
  };

  explicit SvgPlot(Layout layout) : layout_(std::move(layout)) {}

  /// A line through the points; gaps where a coordinate is NaN, infinite or beyond 1e9. Long series
  /// are thinned to the extremes of runs of samples, so peaks stay.
  /// @param color  number of the colour, modulo 8
  void add_line(const std::string& name, int color, const std::vector<double>& x,
                const std::vector<double>& y);

  /// The area between y = low and y = high.
  void add_band(const std::string& name, int color, const std::vector<double>& x,
                const std::vector<double>& low, const std::vector<double>& high);

  /// A dot, for places such as the start.
  void add_marker(const std::string& name, int color, double x, double y);

  /// The legend, where there are two or more series, and the `svg` element; a note "no data" where
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
