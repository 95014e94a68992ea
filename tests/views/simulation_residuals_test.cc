// Residuals of a simulation are those of the pictures of its verification.
#include "ident/views/simulation_residuals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

Plot channel(const std::string& label, double error) {
  Plot plot{.title = label, .x_label = "time [s]", .y_label = label};
  Series measured{.name = "measured", .style = Series::Style::measured};
  Series simulated{.name = "simulated", .style = Series::Style::predicted};
  for (int i = 0; i < 400; ++i) {
    const double t = 0.01 * i, y = std::sin(t);
    measured.x.push_back(t), measured.y.push_back(y);
    simulated.x.push_back(t), simulated.y.push_back(y - error * std::cos(40 * t));
  }
  plot.series = {measured, simulated};
  return plot;
}

TEST(SimulationResiduals, AreMeasuredMinusSimulatedOfRatesAndVerticalForce) {
  const Section section = simulation_residuals(
      {.plots = {channel("p [rad/s]", 0.1), channel("x [m]", 1), channel("az [m/s^2]", 0.5)}});
  ASSERT_EQ(section.plots.size(),
            10U);  // over time, over the input, normal, autocorrelation, spectrum; twice
  EXPECT_EQ(section.plots[0].y_label, "p residual [rad/s]");
  EXPECT_NEAR(section.plots[0].series[0].y[0], 0.1, 1e-12);  // cos 0
  EXPECT_EQ(section.plots[5].y_label, "az residual [m/s^2]");
  const Series& density = section.plots[4].series[1];
  const auto top = std::max_element(density.y.begin(), density.y.end()) - density.y.begin();
  EXPECT_NEAR(density.x[static_cast<std::size_t>(top)], 40 / (2 * M_PI), 0.3);
  EXPECT_EQ(section.plots[3].series.size(), 2U);  // band and bars: nothing was decorrelated
}

TEST(SimulationResiduals, AreEmptyWithoutPairsOfSeries) {
  Plot lonely = channel("p [rad/s]", 0.1);
  lonely.series.pop_back();
  EXPECT_TRUE(simulation_residuals({.plots = {lonely}}).plots.empty());
}

}  // namespace
}  // namespace ident
