// Axes at round numbers, colours by channel, and no more points than a pixel can show.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "ident/report/channel_colour.h"
#include "ident/report/decimate.h"
#include "ident/report/plot_data.h"
#include "ident/report/plot_svg.h"
#include "ident/report/scale.h"
#include "ident/report/svg.h"

namespace ident {
namespace {

Extent extent(double low, double high) {
  Extent e;
  e.add(low), e.add(high);
  return e;
}

std::vector<std::string> labels(const Scale& scale) {
  std::vector<std::string> out;
  for (const Tick& tick : scale.ticks()) out.push_back(tick.label);
  return out;
}

TEST(Scale, PutsTicksAtRoundNumbers) {
  const std::vector<std::string> expected{"−1.0", "−0.5", "0.0", "0.5", "1.0"};
  EXPECT_EQ(labels(Scale::linear(extent(-1.1, 1.2), 5, {})), expected);
}

TEST(Scale, TakesAPowerOfTenOutOfSmallNumbers) {
  const Scale scale = Scale::linear(extent(0, 6.2e-6), 6, {});
  EXPECT_EQ(scale.factor(), "×10⁻⁶");
  EXPECT_EQ(labels(scale).back(), "6");
}

TEST(Scale, ShowsAConstantInTheMiddle) {
  EXPECT_NEAR(Scale::linear(extent(5, 5), 5, {}).position(5), 0.5, 1e-12);
  EXPECT_NEAR(Scale::linear(extent(0, 0), 5, {}).position(0), 0.5, 1e-12);
}

TEST(Scale, HasNoPlaceForZeroOnALogarithm) {
  const Scale scale = Scale::logarithmic(extent(1e-6, 1));
  EXPECT_TRUE(std::isnan(scale.position(0)));
  EXPECT_NEAR(scale.position(1e-3), 0.5, 1e-12);
}

TEST(ChannelColour, IsTheSameForAChannelWhereverItIs) {
  const std::vector<Series> one{{.name = "q predicted"},
                                {.name = "q measured", .style = Series::Style::measured}};
  const std::vector<Series> two{{.name = "other"}, {.name = "q band"}, {.name = "p"}};
  EXPECT_EQ(channel_colours(one)[0], channel_colours(two)[1]);
  EXPECT_NE(channel_colours(two)[0], channel_colours(two)[1]);
  EXPECT_NE(channel_colours(two)[0], channel_colours(two)[2]);
  EXPECT_EQ(channel_colours({{.name = "omega3"}})[0], 2);
}

TEST(Decimate, KeepsTheExtremesOfALongLine) {
  std::vector<PaperPoint> points;
  for (int i = 0; i < 100000; ++i) points.push_back({i * 0.006, 100.0});
  points[31234].y = 5;
  const std::string path = line_path(points);
  EXPECT_LT(path.size(), 40000U);
  EXPECT_NE(path.find(" 5L"), std::string::npos) << "the spike is lost";
}

TEST(Decimate, BreaksALineWhereANumberIsMissing) {
  EXPECT_EQ(line_path({{0, 1}, {1, 1}, {2, kNaN}, {3, 1}, {4, 2}}), "M0 1L1 1M3 1L4 2");
}

TEST(Decimate, GoesRoundABand) {
  EXPECT_EQ(band_path({{0, 2}, {1, 2}}, {{0, 0}, {1, 0}}), "M0 2L1 2L1 2L1 0L1 0L0 0L0 0Z");
}

TEST(PlotData, EncodesAsRfc4648Does) {
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
}

TEST(PlotData, HoldsACommonTimeAxisOnce) {
  Plot plot{.kind = Plot::Kind::time_series};
  plot.series = {{.name = "p", .x = {0, 1}, .y = {5, 6}}, {.name = "q", .x = {0, 1}, .y = {7, 8}}};
  PlotData data;
  data.add(plot, "a");
  data.add(plot, "b");
  EXPECT_EQ(nlohmann::json::parse(data.json()).at("arrays").size(), 3U);
}

TEST(PlotData, ResolvesTimesFarFromZero) {
  // float32 alone resolves 1.6e9 s to 128 s.
  Plot plot{.kind = Plot::Kind::time_series};
  plot.series = {{.name = "p", .x = {1.6e9, 1.6e9 + 0.001}, .y = {0, 1}}};
  PlotData data;
  data.add(plot, "a");
  EXPECT_EQ(nlohmann::json::parse(data.json()).at("plots").at(0).at("origin"), 1.6e9);
}

TEST(PlotSvg, SurvivesPlotsWithoutDrawableData) {
  Plot plot{.title = "empty", .x_label = "x", .y_label = "y"};
  EXPECT_NE(plot_svg(plot, "a").find("</svg>"), std::string::npos);
  plot.series = {{.name = "s", .x = {kNaN, 1}, .y = {kNaN, kNaN}},
                 {.name = "b", .style = Series::Style::bars}};
  for (const bool log : {false, true}) {
    plot.log_x = plot.log_y = log;
    const std::string svg = plot_svg(plot, "a");
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
  }
  plot.kind = Plot::Kind::heat_map;
  EXPECT_NE(plot_svg(plot, "a").find("</svg>"), std::string::npos);
  plot.cells = Eigen::MatrixXd::Constant(2, 2, kNaN);
  EXPECT_EQ(plot_svg(plot, "a").find("opacity:nan"), std::string::npos);
}

TEST(PlotSvg, NumbersAlongAnAxisDoNotRunIntoEachOther) {
  Plot plot{.title = "t", .x_label = "x", .y_label = "y"};
  plot.series = {{.name = "p", .x = {-16200, -9000}, .y = {-1.62e4, -9000}}};
  const std::string svg = plot_svg(plot, "a", PlotWidth::half);
  const std::regex label(R"re(<text x="([0-9.]+)" y="[0-9.]+" class="middle">([^<]*000)<)re");
  double end = -1e9;
  int labels = 0;
  for (std::sregex_iterator at(svg.begin(), svg.end(), label), none; at != none; ++at, ++labels) {
    const double middle = std::stod((*at)[1]), half = label_width((*at)[2].str()) / 2;
    EXPECT_GT(middle - half, end + 5) << (*at)[2];
    end = middle + half;
  }
  EXPECT_GE(labels, 3);
}

TEST(PlotSvg, CarriesItsColoursWhenItStandsAlone) {
  Plot plot{.title = "t"};
  plot.series = {{.name = "p", .x = {0, 1}, .y = {0, 1}}};
  EXPECT_NE(standalone_svg(plot).find("--c0: #"), std::string::npos);
  EXPECT_EQ(plot_svg(plot, "a").find("--c0: #"), std::string::npos);
}

}  // namespace
}  // namespace ident
