// Compares the size of each cause found with how far the other smoothing of the speeds moves it.
#include "ident/gap/verdict/input_smoothing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/core/word_list.h"
#include "ident/flight/fit/fit_covariance.h"

namespace ident {
namespace {

// Share of a cause's size that may move, both in standard deviations, and what counts as moved at all.
constexpr double kMovesBy = 0.25, kMoves = 1.0;
constexpr double kAtTheFloor = 1.1;

}  // namespace

std::vector<std::string> depend_on_smoothing(const FittedModel& model, const Eigen::VectorXd& moved) {
  const Theta& theta = *model.theta;
  const Eigen::VectorXd &u = model.fit.u, other = u + moved;
  std::vector<std::string> loose;
  for (const Candidate& cause : model.adopted) {
    double size = 0, moves = 0;
    for (int i = 0; i < theta.constants_count(); ++i) {
      const FreeConstant& constant = theta.constants()[static_cast<std::size_t>(i)];
      if (!is_constant_of(cause, constant, i)) continue;
      const double std = theta.deviation(u, i, model.fit.covariance), value = theta.physical(u, i);
      if (!(std > 0)) continue;
      size += std::pow((value - value_without(cause, constant)) / std, 2);
      moves += std::pow((theta.physical(other, i) - value) / std, 2);
    }
    if (moves > kMoves * kMoves && moves > kMovesBy * kMovesBy * size) loose.push_back(cause.name);
  }
  return loose;
}

double least_size(const FlightRecord& record) {
  constexpr double kRows = 3.0, kTimes = 3.0;
  const double lag = 2 * record.p[param::zeta_m] / record.p[param::omega_m];
  return lag < kRows * record.interval ? kTimes : 1.0;
}

double refitted_error(const FittedModel& model, const FlightRecord& record, const FlightRecord& held_out,
                      const NoiseModel& noise, PredictionOptions options) {
  options.horizons = {0.5};
  const Eigen::VectorXd u = fit_of_training(model.fit, record, *model.theta, kTrainingShare);
  const auto windows = predict_windows(held_out, *model.theta, u, noise, options);
  return gap_closed(windows[0], windows[0]).after;
}

Judged with_noisy_input(Judged verdict, const std::vector<std::string>& loose,
                        const std::vector<std::string>& small, const GapClosed& gap, double without) {
  const auto is_small = [&](const std::string& name) {
    return std::ranges::find(small, name) != small.end();
  };
  if (!verdict.effects.empty() && std::ranges::all_of(verdict.effects, is_small) &&
      without < kAtTheFloor * gap.floor) {
    const std::string all = fmt::format("{}", fmt::join(verdict.effects, " with "));
    verdict = unnamed(std::move(verdict));
    verdict.status = "none", verdict.confused_with.clear();
    verdict.sentence = fmt::format(
        "With its constants refitted the model explains these logs down to the noise. What is left looks "
        "like {} of hardly a size that could be seen, and measured rotor speeds are the input here: what "
        "they do between their samples is as large. Log the commands too.",
        all);
    return verdict;
  }
  std::vector<std::string> against;
  for (const std::string& name : verdict.effects)
    if (gap.after >= gap.before || std::ranges::find(loose, name) != loose.end()) against.push_back(name);
  if (!against.empty()) {
    verdict.sentence =
        fmt::format("{} {} not named: {}. {}", listed(against), against.size() == 1 ? "is" : "are",
                    gap.after >= gap.before ? "held-out flight is predicted no better with that"
                                            : "the size depends on how the rotor speeds are smoothed",
                    verdict.sentence);
    verdict = unnamed(std::move(verdict), against);
  }
  if (verdict.status == "unknown")
    verdict.sentence +=
        " Measured rotor speeds are the input here, and their noise may be all of it: log the commands too.";
  return verdict;
}

Judged with_jitter(Judged verdict) {
  if (verdict.status == "unknown")
    verdict.sentence +=
        " Rotor speeds jump from row to row as no command says, and the vehicle feels it: that may be all of "
        "it.";
  return verdict;
}

}  // namespace ident
