// Frees wrong parameters of their priors, then the fit of any model.
#include "ident/gap/hypotheses/fitted_model.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "ident/core/error.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/fit/fitted_parameters.h"
#include "ident/flight/fit/physical_inertia.h"
#include "ident/gap/hypotheses/screen.h"

namespace ident {
namespace {

constexpr double kByChance = 2.0;  // standard deviations

// An effect taken up that the fit drove beyond what it can physically be. A payload's place is the ratio of
// two unknowns: where its mass is not seen it may be anywhere, and a verdict says so.
bool beyond_physics(const FittedModel& model) {
  for (std::size_t i = 0; i < model.constants.size(); ++i) {
    const FreeConstant& c = model.constants[i];
    const EffectParameter* effect = find_effect_parameter(c.name);
    if (!c.adopted || !effect || c.name.starts_with("payload.")) continue;
    const int k = static_cast<int>(i);
    const double beyond =
        std::abs(model.theta->physical(model.fit.u, k) - effect->null_value) - kFarther * physical_limit(c);
    if (beyond > kByChance * model.theta->deviation(model.fit.u, k, model.fit.covariance)) return true;
  }
  return false;
}

}  // namespace

FittedModel fitted(std::vector<FreeConstant> constants, std::vector<Candidate> adopted,
                   const FlightRecord& record, const std::vector<double>& p,
                   const FlightFitOptions& options) {
  FittedModel model;
  model.constants = std::move(constants);
  model.adopted = std::move(adopted);
  std::vector<FreeConstant> freed = model.constants;
  for (const Candidate& c : model.adopted)
    if (c.parameter >= 0) {
      FreeConstant& f = freed[static_cast<std::size_t>(c.parameter)];
      f.prior_std = std::max(kDropped * f.prior_std.value_or(std::abs(f.start)), f.unit());
      know_alone(freed, f.index);
    }
  model.theta = std::make_shared<Theta>(p, freed, record.logs, record.signals.rates);
  try {
    model.fit = fit_flight(record, *model.theta, options);
  } catch (const DataError&) {  // it cannot be simulated: no model that stands
  }
  return model;
}

bool stands(const FittedModel& model) {
  const FlightFit& fit = model.fit;
  return fit.converged && fit.covariance.allFinite() && fit.information.allFinite() && !beyond_physics(model);
}

Vehicle adopted_vehicle(const Vehicle& vehicle, const FittedModel& model) {
  Vehicle out = vehicle;
  const Theta& theta = *model.theta;
  const Eigen::VectorXd u = nearest_body(theta, model.fit);
  std::set<std::string> refitted;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const std::string& name = theta.constants()[static_cast<std::size_t>(i)].name;
    const double value = theta.physical(u, i);
    if (name == "dead_time" && value < 0) continue;  // of clocks, not of motors
    out.parameters[name] = {value, theta.deviation(u, i, model.fit.covariance)};
    refitted.insert(name);
  }
  out.correlation =
      vehicle.correlation.renewed(flight_correlation(theta, u, model.fit.covariance),
                                  [&](const std::string& name) { return refitted.contains(name); });
  for (Rotor& rotor : out.rotors) rotor.a_B = axis_at(rotor, slant_angle(out));
  return out;
}

}  // namespace ident
