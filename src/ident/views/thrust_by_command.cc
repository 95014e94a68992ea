// The curve and its deviation, by the covariance of the constants that make it.
#include "ident/views/thrust_by_command.h"

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kLow = 0.05, kHigh = 0.95;  // of the commands
constexpr int kSteps = 18;                   // between them
constexpr int kInTable = 3;                  // every so many of these

std::vector<double> commands_in_flight(const FlightRecord& record, std::span<const FlightLog> logs) {
  std::vector<double> all;
  for (const FlightArc& arc : record.arcs) {
    const FlightLog& log = logs[static_cast<std::size_t>(arc.log)];
    const auto from = std::ranges::lower_bound(log.t, arc.t.front()) - log.t.begin(),
               to = std::ranges::upper_bound(log.t, arc.t.back()) - log.t.begin();
    for (const std::vector<double>& delta : log.delta)
      if (!delta.empty()) all.insert(all.end(), delta.begin() + from, delta.begin() + to);
  }
  return all;
}

ThrustAt thrust_at(double command, const Theta& theta, const FlightFit& fit, const std::vector<double>& p) {
  const double Omega = p[param::Omega_0] + p[param::km] * command, T = p[param::kT] * Omega * Omega;
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(fit.u.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    const int index = theta.constants()[static_cast<std::size_t>(i)].index;
    const double by = index == param::kT        ? Omega * Omega
                      : index == param::km      ? 2 * p[param::kT] * Omega * command
                      : index == param::Omega_0 ? 2 * p[param::kT] * Omega
                                                : 0.0;
    slope[i] = by * theta.slope(fit.u, i);
  }
  return {command, T, std::sqrt(slope.dot(fit.covariance * slope))};
}

}  // namespace

std::vector<ThrustAt> thrust_over_commands(const FlightRecord& record, std::span<const FlightLog> logs,
                                           const Theta& theta, const FlightFit& fit) {
  if (!record.signals.commands) return {};
  const std::vector<double> flown = commands_in_flight(record, logs);
  const double low = quantile(flown, kLow), high = quantile(flown, kHigh);
  const std::vector<double> p = theta.p(fit.u);
  std::vector<ThrustAt> curve;
  for (int k = 0; k <= kSteps && high > low; ++k)
    curve.push_back(thrust_at(low + (high - low) * k / kSteps, theta, fit, p));
  return curve;
}

nlohmann::ordered_json as_json(const std::vector<ThrustAt>& curve) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < curve.size(); k += kInTable)
    all.push_back({{"command", curve[k].command}, {"thrust", curve[k].thrust}, {"std", curve[k].std}});
  return all;
}

Section thrust_section(const std::vector<ThrustAt>& curve) {
  Section section{.title = "Thrust over the flown commands",
                  .text =
                      "Of one rotor in steady flow, over all but the least and the highest twentieth of "
                      "the commands in flight. What is known of it may be more than of kT or km alone."};
  Table table{"Thrust of a rotor", {"command", "thrust N"}, {}};
  Series band{.name = "95 % interval", .style = Series::Style::band}, line{.name = "thrust"};
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const auto& [command, thrust, std] = curve[k];
    line.x.push_back(command), line.y.push_back(thrust);
    band.x.push_back(command);
    band.y.push_back(thrust - 1.96 * std), band.y2.push_back(thrust + 1.96 * std);
    if (k % kInTable == 0)
      table.rows.push_back({format_number(command, 3), format_with_uncertainty(thrust, std)});
  }
  section.tables.push_back(std::move(table));
  section.plots.push_back({.id = "thrust_by_command",
                           .title = "Thrust of a rotor over its command",
                           .caption = "A curve beyond the flown commands would be a guess.",
                           .x_label = "command [-]",
                           .y_label = "thrust [N]",
                           .series = {std::move(band), std::move(line)}});
  return section;
}

}  // namespace ident
