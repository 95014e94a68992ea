// Where the residual lies, by channel, regime, frequency band and time.
#include "ident/gap/views/gap_where.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace ident {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

double rounded(double x) { return std::round(1e4 * x) / 1e4; }

// Channels that stand above their noise: where the others lie tells nothing.
std::vector<Index> loud_channels(const ResidualWrench& w) {
  const VectorXd excess = w.excess();
  std::vector<Index> loud;
  for (Index c = 0; c < excess.size(); ++c)
    if (excess[c] > 0) loud.push_back(c);
  return loud;
}

// Power of the residual per row, each channel over its noise, the noise itself taken off.
VectorXd power(const ResidualWrench& w) {
  VectorXd sum = VectorXd::Zero(w.residual.rows());
  for (const Index c : loud_channels(w))
    sum += ((w.residual.col(c) / w.noise[c]).cwiseAbs2().array() - 1).matrix();
  return sum;
}

Json regimes(const ResidualWrench& w, const VectorXd& excess) {
  Json out = Json::array();
  const double total = std::max(excess.sum(), 1e-12);
  for (const auto& [name, x] : w.regimes) {
    std::vector<double> sorted(x.data(), x.data() + x.size());
    std::ranges::sort(sorted);
    double best = -1e300;
    Json top;
    for (int bin = 0; bin < 4; ++bin) {
      const double low = sorted[sorted.size() * static_cast<std::size_t>(bin) / 4];
      const double high =
          sorted[std::min(sorted.size() - 1, sorted.size() * static_cast<std::size_t>(bin + 1) / 4)];
      double share = 0;
      for (Index k = 0; k < x.size(); ++k)
        if (x[k] >= low && (x[k] < high || bin == 3)) share += excess[k];
      share /= total;
      if (share > best)
        best = share, top = {{"variable", name},
                             {"bin", {rounded(low), rounded(high)}},
                             {"share", std::clamp(rounded(share), 0.0, 1.0)},
                             {"chance", 0.25}};
    }
    if (!top.is_null()) out.push_back(top);
  }
  std::stable_sort(out.begin(), out.end(), [](const Json& a, const Json& b) {
    return a["share"].get<double>() > b["share"].get<double>();
  });
  return out;
}

constexpr Index kBlock = 512;  // rows that are transformed at once

// First rows of the blocks, which overlap by half; none lies across two logs.
std::vector<Index> blocks(const ResidualWrench& w, Index length) {
  std::vector<Index> starts;
  const Index n = w.residual.rows();
  for (Index k = 0; k + length <= n;) {
    const bool one_log =
        w.log[static_cast<std::size_t>(k)] == w.log[static_cast<std::size_t>(k + length - 1)];
    if (one_log) starts.push_back(k);
    k += one_log ? std::max<Index>(1, length / 2) : 1;
  }
  return starts;
}

// Power over the noise at frequency f/length, 1 for white noise.
double power_at(const ResidualWrench& w, Index channel, Index start, Index length, Index f) {
  const std::complex<double> turn =
      std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(f) / static_cast<double>(length));
  std::complex<double> phase = 1, sum = 0;
  for (Index k = 0; k < length; ++k, phase *= turn) sum += w.residual(start + k, channel) * phase;
  return std::norm(sum / w.noise[channel]) / static_cast<double>(length);
}

Json bands(const ResidualWrench& w) {
  const Index n = w.residual.rows();
  if (n < 32) return Json::array();
  std::vector<double> steps;
  for (std::size_t k = 1; k < w.t.size(); ++k)
    if (w.log[k] == w.log[k - 1]) steps.push_back(w.t[k] - w.t[k - 1]);
  if (steps.empty()) return Json::array();
  std::ranges::sort(steps);
  const double dt = std::max(steps[steps.size() / 2], 1e-6);
  const std::array<double, 6> edges{0.0, 0.1, 0.3, 1.0, 3.0, 0.5 / dt};
  std::array<double, 5> sum{};
  const Index length = std::min(n, kBlock);
  for (const Index start : blocks(w, length))
    for (const Index c : loud_channels(w))
      for (Index f = 0; f < length / 2; ++f) {
        const double hz = static_cast<double>(f) / (static_cast<double>(length) * dt);
        for (std::size_t b = 0; b < 5; ++b)
          if (hz >= edges[b] && hz < edges[b + 1]) sum[b] += power_at(w, c, start, length, f) - 1;
      }
  double total = 1e-12;
  for (double& s : sum) s = std::max(s, 0.0), total += s;
  Json out = Json::array();
  for (std::size_t b = 0; b < 5; ++b)
    if (edges[b + 1] > edges[b])
      out.push_back({{"hz", {edges[b], rounded(edges[b + 1])}}, {"share", rounded(sum[b] / total)}});
  return out;
}

Json times(const ResidualWrench& w, const VectorXd& excess) {
  Json out = Json::array();
  const double total = std::max(excess.cwiseMax(0.0).sum(), 1e-12);
  std::size_t k = 0;
  while (k < w.t.size()) {
    const double from = w.t[k];
    const int log = w.log[k];
    double sum = 0, to = from;
    for (; k < w.t.size() && w.log[k] == log && w.t[k] < from + 5; ++k)
      sum += std::max(excess[static_cast<Index>(k)], 0.0), to = w.t[k];
    out.push_back(
        {{"log", log + 1}, {"from", rounded(from)}, {"to", rounded(to)}, {"share", rounded(sum / total)}});
  }
  std::stable_sort(out.begin(), out.end(), [](const Json& a, const Json& b) {
    return a["share"].get<double>() > b["share"].get<double>();
  });
  if (out.size() > 6) out.erase(out.begin() + 6, out.end());
  return out;
}

}  // namespace

Json where_json(const ResidualWrench& w) {
  Json out;
  const VectorXd rms = w.rms(), excess = w.excess();
  const double total = std::max(excess.sum(), 1e-12);
  Json channels = Json::array();
  for (Index c = 0; c < rms.size(); ++c)
    channels.push_back({{"name", w.names[static_cast<std::size_t>(c)]},
                        {"rms", rms[c]},
                        {"noise", w.noise[c]},
                        {"share", rounded(excess[c] / total)}});
  std::stable_sort(channels.begin(), channels.end(), [](const Json& a, const Json& b) {
    return a["share"].get<double>() > b["share"].get<double>();
  });
  out["channels"] = channels;
  const VectorXd p = power(w);
  out["regimes"] = regimes(w, p);
  out["bands"] = bands(w);
  out["times"] = times(w, p);
  return out;
}

}  // namespace ident
