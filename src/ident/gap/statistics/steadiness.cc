// Kurtosis of the residual, with as many independent samples as its colour leaves.
#include "ident/gap/statistics/steadiness.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "ident/result/section.h"

namespace ident {
namespace {

constexpr double kStretchSteadiness = 3.0;    // s
constexpr std::size_t kLeastSteadiness = 60;  // rows of a log that can be judged

struct Series {
  std::vector<double> t, y;
};

Series series_of(const ResidualWrench& w, Eigen::Index channel, int log) {
  Series out;
  for (std::size_t k = 0; k < w.t.size(); ++k)
    if (const double y = w.residual(static_cast<Eigen::Index>(k), channel);
        w.log[k] == log && std::isfinite(y))
      out.t.push_back(w.t[k]), out.y.push_back(y);
  double mean = 0;
  for (const double y : out.y) mean += y / static_cast<double>(out.y.size());
  for (double& y : out.y) y -= mean;
  return out;
}

// Correlation of neighbours by their signs, to which it does not matter how large a burst is: of a normal
// process with correlation rho they agree with a probability of 1/2 + asin(rho)/pi.
double carried_over(const std::vector<double>& y) {
  std::vector<double> sorted = y;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  double agree = 0;
  for (std::size_t k = 1; k < y.size(); ++k) agree += (y[k] - *middle) * (y[k - 1] - *middle) > 0;
  const double share = agree / static_cast<double>(y.size() - 1);
  return std::clamp(std::sin(M_PI * (share - 0.5)), 0.0, 0.99);
}

// Of n independent samples of a normal process the kurtosis is 3 with a variance of 24/n; its logarithm is
// nearer to normal.
std::optional<Unsteady> judged(const Series& s, const std::string& channel, int log) {
  const auto n = static_cast<double>(s.y.size());
  if (s.y.size() < kLeastSteadiness) return {};
  double second = 0, fourth = 0;
  for (const double y : s.y) second += y * y / n, fourth += y * y * y * y / n;
  if (!(second > 0)) return {};
  // Squares of a normal process are correlated by the square of its own correlation.
  const double carried = std::pow(carried_over(s.y), 2), independent = n * (1 - carried) / (1 + carried);
  Unsteady out{channel, log, fourth / (second * second)};
  out.deviations = std::log(out.kurtosis / 3) / (std::sqrt(24 / independent) / 3);
  std::map<int, double> power;
  for (std::size_t k = 0; k < s.y.size(); ++k)
    power[static_cast<int>(s.t[k] / kStretchSteadiness)] += s.y[k] * s.y[k];
  const auto most = std::ranges::max_element(power, {}, [](const auto& stretch) { return stretch.second; });
  out.from = kStretchSteadiness * most->first, out.to = out.from + kStretchSteadiness;
  out.share = most->second / (n * second);
  return out;
}

}  // namespace

std::vector<Unsteady> unsteady(const ResidualWrench& wrench) {
  std::vector<Unsteady> out;
  for (Eigen::Index c = 0; c < std::min<Eigen::Index>(5, wrench.residual.cols()); ++c)  // Fx to My
    for (int log = 0; !wrench.log.empty() && log <= wrench.log.back(); ++log)
      if (const auto one = judged(series_of(wrench, c, log), wrench.names[static_cast<std::size_t>(c)], log))
        out.push_back(*one);
  std::ranges::sort(out, std::greater<>(), &Unsteady::deviations);
  return out;
}

}  // namespace ident
