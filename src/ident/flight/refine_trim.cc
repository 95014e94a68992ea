// What a refinement and a verification say where all that is left is the balance of the rotors.
#include "ident/flight/refine_trim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/flight/checks/unidentifiable.h"
#include "ident/flight/fit/fitted_parameters.h"
#include "ident/flight/trim/trim.h"
#include "ident/flight/trim/trim_fit.h"

namespace ident {

using Eigen::Index;
using Eigen::VectorXd;

Warning without_turning() {
  return {
      "no_turning",
      "The logs have neither rates nor attitude, so the motion of the vehicle is not known. Only the balance "
      "of the rotors over some seconds is estimated: thrust for a command, and each rotor relative to the "
      "others. Motors, inertia, drag, delays and sensors are not. Log rates or attitude."};
}

std::string scatter_in_words(const Trim& trim, const TrimScatter& scatter) {
  if (scatter.rotor == 0)
    return "What a rotor's thrust scatters by from flight to flight is in its deviation as stated.";
  return fmt::format(
      "From flight to flight the thrust of a rotor for a command scatters by {:.1f} %, that of all together "
      "by "
      "{:.1f} %{}.",
      100 * scatter.rotor, 100 * scatter.level,
      trim.logs == 1 ? ", as is usual: one flight does not tell" : "");
}

Section trim_section(const FlightRecord& record, const Trim& trim, const VectorXd& y) {
  Section section;
  section.title = "Balance of the rotors";
  section.text = fmt::format(
      "Thrust and moments of the rotors at the speeds of their commands, over {} stretches of {:.0f} s or "
      "more "
      "in {} log{}.",
      trim.stretches.size(), kShortestStretch, trim.logs, trim.logs == 1 ? "" : "s");
  Table table{"What is left, in % of the weight (moments: of thrust times arm)",
              {"log", "stretches", "thrust", "Mx", "My", "Mz"},
              {}};
  for (int log = 0; log < record.logs; ++log) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    int count = 0;
    for (std::size_t k = 0; k < trim.stretches.size(); ++k)
      if (trim.stretches[k].log == log)
        sum += y.segment<kTrimChannels>(kTrimChannels * static_cast<Index>(k)), ++count;
    if (count == 0) continue;
    std::vector<std::string> row{std::to_string(log + 1), std::to_string(count)};
    for (Index c = 0; c < kTrimChannels; ++c) row.push_back(fmt::format("{:+.2f}", 100 * sum[c] / count));
    table.rows.push_back(std::move(row));
  }
  section.tables.push_back(std::move(table));
  return section;
}

void verify_trim(Result& result, const FlightRecord& record, const std::vector<double>& p) {
  const Trim trim = make_trim(record, p);
  const VectorXd y = unbalance(record, trim, p);
  result.warnings.push_back(without_turning());
  result.sections.push_back(trim_section(record, trim, y));
  result.fit["seconds"] = record.duration;
  result.fit["stretches"] = trim.stretches.size();
  const auto rms = [&](Index channel) {
    return std::sqrt(y(Eigen::seq(channel, Eigen::last, Index{kTrimChannels})).squaredNorm() /
                     static_cast<double>(trim.stretches.size()));
  };
  result.fit["unbalance"] = {{"thrust", rms(0)}, {"Mx", rms(1)}, {"My", rms(2)}, {"Mz", rms(3)}};
  result.verdict = fmt::format(
      "Nothing can be simulated without rates or attitude. Over {:.0f} s of flight the thrust of the model's "
      "rotors is {:.1f} % off what the path needs (RMS), and their moments {:.1f} % of thrust times arm off "
      "balance.",
      record.duration, 100 * rms(0), 100 * std::hypot(rms(1), rms(2), rms(3)));
}

void refine_trim(Result& result, const FlightRecord& record, const std::vector<double>& p,
                 const std::vector<std::string>& free) {
  const Theta theta(p, trim_constants(record, p, free), record.logs, false);
  const Trim trim = make_trim(record, p);
  TrimFit found = fit_trim(record, trim, theta, true);
  // What is written serves for the next flight, and that scatters too.
  const auto& all = theta.constants();
  const std::string carries = std::ranges::find(all, "kT", &FreeConstant::name) != all.end() ? "kT" : "km";
  for (int i = 0; i < theta.constants_count(); ++i)
    if (const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)]; is_rotor_ratio(c.name))
      found.fit.covariance(i, i) += std::pow(std::max(found.scatter.rotor, kUsualScatter) / c.unit(), 2);
    else if (c.name == carries)  // its logarithm; thrust goes with the square of km
      found.fit.covariance(i, i) +=
          std::pow(std::max(found.scatter.level, kUsualLevel) / (carries == "kT" ? 1 : 2), 2);
  result.warnings.push_back(without_turning());
  if (trim.logs == 1 && found.scatter.rotor > 0)
    result.warn("one_flight", fmt::format("One flight does not tell how the balance of the rotors changes "
                                          "from flight to flight. {:.0f} % is assumed. Give several logs.",
                                          100 * found.scatter.rotor));
  result.parameters = flight_parameters(theta, found.fit, "flightlog");
  result.fit["seconds"] = record.duration;
  result.fit["stretches"] = trim.stretches.size();
  result.fit["rotor_scatter"] = found.scatter.rotor;
  result.fit["level_scatter"] = found.scatter.level;
  warn_about(result, theta, found.fit);
  result.sections.push_back(trim_section(record, trim, found.y));
  result.sections.back().text += " " + scatter_in_words(trim, found.scatter);
  int known = 0;
  for (const Parameter& q : result.parameters) known += q.identifiable;
  result.verdict = fmt::format(
      "Without rates or attitude {:.0f} s of flight tell the balance of the rotors only: {} of {} "
      "parameters.",
      record.duration, known, result.parameters.size());
}

}  // namespace ident
