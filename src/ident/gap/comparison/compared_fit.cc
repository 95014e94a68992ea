// The model with all causes at once, as a search fits its sets, and its constants in physical units.
#include "ident/gap/comparison/compared_fit.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "ident/core/error.h"
#include "ident/core/word_list.h"
#include "ident/effects/cause_traits.h"
#include "ident/flight/fit/fit_covariance.h"
#include "ident/flight/fit/hover_priors.h"
#include "ident/flight/prepare.h"
#include "ident/flight/record/flight_record.h"
#include "ident/flight/trim/trim.h"
#include "ident/gap/search/search_state.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Fall of the cost that a last step may take unseen. [-] As at the end of a search.
constexpr double kUnseen = 0.5;

std::vector<FreeConstant> base_constants(const FlightEntry& entry, const Vehicle& vehicle, bool hover) {
  std::vector<FreeConstant> base = free_constants(vehicle, entry.p);
  if (!entry.record.signals.commands) leave_out_motors(base);
  if (hover) hold_for_hover(base, Held::unstated);
  return base;
}

std::string cause_of(const std::vector<Candidate>& causes, const FreeConstant& constant, int i) {
  const auto owns = [&](const Candidate& c) { return is_constant_of(c, constant, i); };
  const auto cause = std::ranges::find_if(causes, owns);
  return cause == causes.end() ? std::string() : cause->name;
}

ComparedFit in_own_units(const FittedModel& model) {
  const Theta& theta = *model.theta;
  const Eigen::VectorXd& u = model.fit.u;
  const Index n = theta.constants_count();
  const PriorTerms prior = theta.prior(u);
  const MatrixXd J = theta.slopes(u), C = model.fit.covariance.topLeftCorner(n, n);
  const MatrixXd known = (prior.slope.asDiagonal() * prior.precision * prior.slope.asDiagonal());
  const MatrixXd response = MatrixXd::Identity(n, n) - C * known.topLeftCorner(n, n);
  ComparedFit out{.value = Eigen::VectorXd(n),
                  .covariance = J * C * J.transpose(),
                  .response = J * response * J.inverse()};
  for (int i = 0; i < n; ++i) {
    const FreeConstant& constant = theta.constants()[static_cast<std::size_t>(i)];
    out.names.push_back({constant.name, cause_of(model.adopted, constant, i)});
    out.value[i] = theta.physical(u, i);
  }
  return out;
}

}  // namespace

ComparedFit compared_fit(const Vehicle& vehicle, std::span<const FlightLog> logs,
                         const std::vector<Candidate>& causes) {
  Result told_before;  // by the diagnosis of these logs
  const FlightEntry entry = enter_flight(vehicle, logs, told_before);
  const FlightRecord& record = entry.record;
  if (only_trim(record.signals))
    throw DataError(logs.front().file + ": a comparison needs body rates or attitude in both logs");
  require_turning(record.signals);
  const bool hover = is_hover(entry.tested);
  SearchOptions options{.most_causes = static_cast<int>(causes.size()), .hover = hover, .fine_gusts = false};
  SearchState search(record, vehicle, entry.p, options);
  FlightFitOptions patient = search.fit;
  patient.most_steps = 0;
  FittedModel model = fitted(base_constants(entry, vehicle, hover), {}, record, entry.p, patient);
  if (!stands(model))
    throw DataError(logs.front().file +
                    ": the model as it is cannot be fitted: simulations with it run away");
  search.fit.steps = model.fit.smoother->steps();
  const Standing base = search.at(std::move(model));
  const std::vector<int> places = places_of(causes, base.problem);
  FittedModel all = places.empty() ? base.model : with_causes(record, vehicle, base, places, search.fit);
  if (!stands(all)) {
    std::vector<std::string> names;
    for (const Candidate& c : causes) names.push_back(c.name);
    throw DataError(
        fmt::format("{}: no model with {} can be flown along this log", logs.front().file, listed(names)));
  }
  search.fit.tolerance_of_misfit = 0, search.fit.tolerance = kUnseen;
  all.fit.smoother->set_steps(Steps::fine);
  finish_fit(all.fit, *all.theta, search.fit);
  ComparedFit out = in_own_units(all);
  for (const Candidate& cause : causes)
    if (std::ranges::none_of(all.adopted, [&](const Candidate& a) { return same(a, cause); }))
      out.not_shown.push_back(cause.name);
  return out;
}

}  // namespace ident
