// The spectrum of residuals: power is kept, white noise stays in its band, a tone stands out where it is.
#include "ident/plots/spectrum_plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace ident {
namespace {

constexpr double kInterval = 0.004;  // s

std::vector<double> white_noise(std::size_t n, double sigma) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal(0.0, sigma);
  std::vector<double> y(n);
  for (double& v : y) v = normal(engine);
  return y;
}

double integral(const Spectrum& s) {
  double sum = 0.0;
  for (const double d : s.density) sum += d * s.frequency.front();  // equal steps from the first
  return sum;
}

TEST(ResidualSpectrum, IntegratesToTheVariance) {
  const Spectrum s = spectrum_of(white_noise(20000, 0.3), kInterval);
  EXPECT_NEAR(integral(s), 0.09, 0.09 * 0.05);
  EXPECT_NEAR(s.white * 0.5 / kInterval, 0.09, 0.09 * 0.03);  // white up to half the sample rate
}

TEST(ResidualSpectrum, KeepsNinetyFivePercentOfWhiteNoiseInItsBand) {
  for (const std::size_t n : {600, 20000}) {
    const Spectrum s = spectrum_of(white_noise(n, 1.0), kInterval);
    const auto inside = std::ranges::count_if(s.density, [&](double d) { return d > s.low && d < s.high; });
    // 256 neighbouring densities are correlated by the window: about 85 independent ones, four binomial
    // errors.
    EXPECT_NEAR(static_cast<double>(inside) / static_cast<double>(s.density.size()), 0.95, 0.095) << n;
  }
}

TEST(ResidualSpectrum, ShowsAToneAtItsFrequency) {
  std::vector<double> y = white_noise(4000, 0.1);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += std::sin(2 * std::numbers::pi * 31.0 * kInterval * static_cast<double>(i));
  const Spectrum s = spectrum_of(y, kInterval);
  const auto top = std::ranges::max_element(s.density);
  EXPECT_NEAR(s.frequency[static_cast<std::size_t>(top - s.density.begin())], 31.0, 0.5);
  EXPECT_GT(*top, 20 * s.high);
}

TEST(ResidualSpectrum, IsEmptyForTooFewSamples) {
  EXPECT_TRUE(spectrum_of(white_noise(10, 1.0), kInterval).density.empty());
  EXPECT_TRUE(spectrum_plot({"a", "a", "N"}, white_noise(10, 1.0), kInterval).series[1].x.empty());
}

}  // namespace
}  // namespace ident
