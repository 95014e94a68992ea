// A slip of the pen among thrust readings spoils neither the scale nor the pictures.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/bench/thrust/thrust_sweep_points.h"
#include "ident/plots/residual_plots.h"

namespace ident {
namespace {

SweepChannel channel_with(double slip) {
  SweepChannel channel{.name = "thrust", .unit = "N"};
  channel.start_constant = 6e-6;
  for (int i = 1; i <= 20; ++i) channel.moving.push_back({i * 40.0, 6e-6 * i * i * 1600.0});
  channel.moving[10].value = slip;
  return channel;
}

TEST(ThrustOutlier, FullScaleIsThatOfTheOtherReadings) {
  EXPECT_DOUBLE_EQ(channel_with(1e9).full_scale(), 6e-6 * 640000.0);
  EXPECT_DOUBLE_EQ(channel_with(3.0).full_scale(), 6e-6 * 640000.0);
}

TEST(ThrustOutlier, ThePictureOfResidualsKeepsItsScaleAndSaysWhatIsBeyond) {
  const std::vector<double> x{1, 2, 3, 4}, residual{0.1, -0.1, 1e9, 0.3};
  const Plot plot = residual_plot({.id = "a", .channel = "thrust", .unit = "N"}, x, "row", residual,
                                  {false, false, true, true});
  ASSERT_EQ(plot.series.size(), 2U);
  EXPECT_EQ(plot.series[1].y, std::vector<double>{0.3});
  EXPECT_NE(plot.caption.find("left out: 1"), std::string::npos) << plot.caption;
}

TEST(ThrustOutlier, AutocorrelationIsOfWhatIsKept) {
  std::vector<double> residual, kept;
  for (int i = 0; i < 100; ++i) residual.push_back(std::sin(0.7 * i)), kept.push_back(residual.back());
  const ResidualNames names{.id = "a", .channel = "thrust", .unit = "N"};
  residual[50] = 1e6, kept[50] = std::nan("");
  const Plot plot = autocorrelation_plot(names, residual, kept);
  EXPECT_NEAR(plot.series[1].y[0], std::cos(0.7), 0.05);
}

}  // namespace
}  // namespace ident
