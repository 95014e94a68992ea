// Where the residual lies, by channel, regime, frequency band and time; and the sections of the report.
#include "ident/gap/gap_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "ident/core/format_number.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

double rounded(double x) { return std::round(1e4 * x) / 1e4; }

// Power of the residual per row, each channel over its noise, the noise itself taken off.
VectorXd power(const ResidualWrench& w) {
  VectorXd sum = VectorXd::Zero(w.residual.rows());
  for (Index c = 0; c < w.residual.cols(); ++c) sum += (w.residual.col(c) / w.noise[c]).cwiseAbs2();
  return (sum.array() - static_cast<double>(w.residual.cols())).matrix();
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

Json bands(const ResidualWrench& w) {
  const Index n = w.residual.rows();
  if (n < 32) return Json::array();
  const double span = std::max((w.t.back() - w.t.front()), 1e-6), dt = span / static_cast<double>(n - 1);
  const std::array<double, 6> edges{0.0, 0.1, 0.3, 1.0, 3.0, 0.5 / dt};
  std::array<double, 5> sum{};
  const Index use = std::min<Index>(n, 512);
  for (Index c = 0; c < w.residual.cols(); ++c)
    for (Index f = 0; f < use / 2; ++f) {
      std::complex<double> z = 0;
      for (Index k = 0; k < use; ++k)
        z += w.residual(k, c) / w.noise[c] *
             std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(f * k) / static_cast<double>(use));
      const double hz = static_cast<double>(f) / (static_cast<double>(use) * dt),
                   p = std::norm(z) / static_cast<double>(use);
      for (std::size_t b = 0; b < 5; ++b)
        if (hz >= edges[b] && hz < edges[b + 1]) sum[b] += std::max(p - 1, 0.0);
    }
  double total = 1e-12;
  for (const double s : sum) total += s;
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

std::vector<Section> gap_sections(const Json& found, const ResidualWrench& before,
                                  const ResidualWrench& after) {
  std::vector<Section> out;
  Section how;
  how.title = "How far the gap closes";
  Plot waterfall;
  waterfall.id = "waterfall", waterfall.title = "Prediction error over 0.5 s on held-out flight";
  waterfall.y_label = "error over sensor noise [-]";
  Series bars{"error", {}, {}, {}, Series::Style::bars};
  const auto value = [&](const char* key) {
    return found["gap"][key].is_null() ? kNaN : found["gap"][key].get<double>();
  };
  bars.x = {0, 1, 2}, bars.y = {value("before"), value("after"), value("noise_floor")};
  waterfall.series = {bars};
  waterfall.column_names = {"before", "after", "noise floor"};
  how.plots.push_back(waterfall);
  out.push_back(how);
  Section where;
  where.title = "Where the gap lies";
  Table channels{"Residual force and moment", {"channel", "rms", "noise", "share %"}, {}};
  for (const Json& c : found["where"]["channels"])
    channels.rows.push_back({c["name"], format_number(c["rms"], 3), format_number(c["noise"], 3),
                             fmt::format("{:.0f}", 100 * c["share"].get<double>())});
  where.tables.push_back(channels);
  Table regimes{"Where in the flight", {"variable", "from", "to", "share %", "chance %"}, {}};
  for (const Json& c : found["where"]["regimes"])
    regimes.rows.push_back({c["variable"], format_number(c["bin"][0], 3), format_number(c["bin"][1], 3),
                            fmt::format("{:.0f}", 100 * c["share"].get<double>()), "25"});
  where.tables.push_back(regimes);
  for (Index c = 0; c < std::min<Index>(before.residual.cols(), 6); ++c) {
    Plot plot;
    const std::string& name = before.names[static_cast<std::size_t>(c)];
    plot.id = "residual_" + name, plot.title = "Residual " + name, plot.kind = Plot::Kind::time_series;
    plot.x_label = "time [s]", plot.y_label = name + (c < 3 ? " [N]" : " [N m]");
    Series a{"before", {}, {}, {}, Series::Style::measured}, b{"after", {}, {}, {}, Series::Style::predicted};
    for (Index k = 0; k < before.residual.rows() && before.log[static_cast<std::size_t>(k)] == 0; ++k)
      a.x.push_back(before.t[static_cast<std::size_t>(k)]), a.y.push_back(before.residual(k, c));
    for (Index k = 0; k < after.residual.rows() && after.log[static_cast<std::size_t>(k)] == 0; ++k)
      b.x.push_back(after.t[static_cast<std::size_t>(k)]), b.y.push_back(after.residual(k, c));
    plot.series = {a, b};
    where.plots.push_back(plot);
  }
  out.push_back(where);
  Section which;
  which.title = "Which causes were tried";
  Table table{"Every cause, with the size that would have been seen",
              {"cause", "probability", "evidence", "would have seen"},
              {}};
  for (const Json& c : found["candidates"]) {
    std::string limits;
    for (const auto& [name, limit] : c["detection_limit"].items())
      limits += (limits.empty() ? "" : ", ") + name.substr(name.find('.') + 1) + " " +
                (limit.is_null() ? "-" : format_number(limit.get<double>(), 2));
    table.rows.push_back({c["effect"], fmt::format("{:.3f}", c["probability"].get<double>()),
                          fmt::format("{:.1f}", c["evidence"].get<double>()), limits});
  }
  which.tables.push_back(table);
  out.push_back(which);
  return out;
}

}  // namespace ident
