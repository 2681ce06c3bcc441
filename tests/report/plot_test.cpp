#include <gtest/gtest.h>

#include <cmath>

#include "mms/report/plot_axis.hpp"
#include "mms/report/svg_plot.hpp"

namespace mms {
namespace {

using Values = std::vector<double>;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(PlotAxis, TicksAreRoundAndInRange) {
  EXPECT_EQ(ticks({0.0, 10.0}, 2.2), (Values{0, 2, 4, 6, 8, 10}));
  const Values small = ticks({-0.012, 0.011}, 0.005);
  EXPECT_NEAR(small.front(), -0.010, 1e-12);
  EXPECT_NEAR(small.back(), 0.010, 1e-12);
  EXPECT_EQ(tick_label(small.front(), small), "-0.010");
  EXPECT_EQ(tick_label(2000.0, Values{0, 2000}), "2000");
}

TEST(PlotAxis, RangeIgnoresExtremeAndNonFiniteValues) {
  const std::vector<Values> series = {{1.0, NAN, INFINITY}, {3.0, 1e300}};
  const auto range = range_of(series, 0.0);
  ASSERT_TRUE(range);
  EXPECT_EQ(range->min, 1.0);
  EXPECT_EQ(range->max, 3.0);
  EXPECT_FALSE(range_of(std::vector<Values>{{NAN}}, 0.0));
}

TEST(PlotAxis, ConstantGetsMargin) {
  for (const double value : {0.0, -3.0, 1e-12, 1e8}) {
    const auto range = range_of(std::vector<Values>{{value, value}}, 0.04);
    ASSERT_TRUE(range);
    EXPECT_LT(range->min, value);
    EXPECT_GT(range->max, value);
  }
}

TEST(SvgPlot, ShowsNoDataWithoutValues) {
  SvgPlot plot({.title = "t"});
  EXPECT_NE(plot.render().find("no data"), std::string::npos);
  plot.add_line("a", 0, {NAN}, {1.0});
  EXPECT_NE(plot.render().find("no data"), std::string::npos);
}

TEST(SvgPlot, EscapesTexts) {
  SvgPlot plot({.title = "<t>", .x_label = "<x>", .y_label = "<y>"});
  plot.add_line("<script>", 0, {0, 1}, {0, 1});
  plot.add_line("<b>", 0, {0, 1}, {1, 0});
  const std::string svg = plot.render();
  for (const char* raw : {"<t>", "<x>", "<y>", "<script>", "<b>"}) {
    EXPECT_EQ(svg.find(raw), std::string::npos) << raw;
  }
}

TEST(SvgPlot, NanBreaksLine) {
  SvgPlot plot({});
  plot.add_line("a", 0, {0, 1, 2, 3, 4}, {0, 1, NAN, 1, 0});
  const std::string svg = plot.render();
  const std::string line = svg.substr(svg.find("class=\"line"));
  EXPECT_EQ(count(line, "M"), 2U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("n/a"), std::string::npos);
}

TEST(SvgPlot, DownsamplesLongSeriesAndKeepsPeaks) {
  Values x;
  Values y;
  for (int i = 0; i < 100'000; ++i) {
    x.push_back(i);
    y.push_back(i == 54'321 ? 100.0 : std::sin(i));
  }
  SvgPlot plot({.height = 300, .y_from_zero = true});
  plot.add_line("a", 0, x, y);
  const std::string svg = plot.render();
  EXPECT_LT(svg.size(), 60'000U);
  // The peak at 100 of 0..104.04 plotted over 232 px from the bottom at 242 px.
  EXPECT_NE(svg.find(",19.0"), std::string::npos);
}

TEST(SvgPlot, HasLargerTextAndFewerLabelsForNarrowScreens) {
  SvgPlot plot({.width = 900});
  plot.add_line("a", 0, {0, 1}, {0, 1});
  const std::string svg = plot.render();
  EXPECT_NE(svg.find("style=\"--narrow:25px\""), std::string::npos);
  EXPECT_EQ(count(svg, "<text class=\"second\""), (count(svg, "<text") - 2) / 2);
}

TEST(SvgPlot, DrawsClosedBandsAndMarkers) {
  SvgPlot plot({});
  plot.add_band("b", 9, {0, 1}, {0, 0}, {1, 2});
  plot.add_marker("m", 2, 0.5, 0.5);
  const std::string svg = plot.render();
  EXPECT_NE(svg.find("class=\"band c1\""), std::string::npos);
  EXPECT_NE(svg.find("Z\"/>"), std::string::npos);
  EXPECT_NE(svg.find("class=\"marker c2\""), std::string::npos);
}

}  // namespace
}  // namespace mms
