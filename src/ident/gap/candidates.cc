// Lists the causes for a vehicle and the signals that its logs have.
#include "ident/gap/candidates.h"

#include <algorithm>

#include "ident/estimators/flight_trim.h"

namespace ident {
namespace {

FreeConstant effect_constant(const std::string& name, const Vehicle& vehicle, const std::vector<double>& p) {
  const ParameterInfo* info = find_parameter(name);
  FreeConstant c;
  c.name = name;
  c.index = info->index;
  c.start = p[static_cast<std::size_t>(info->index)];
  c.scale = typical_scale(info->index, vehicle, p);
  return c;
}

class Builder {
 public:
  Builder(const Vehicle& vehicle, const std::vector<double>& p, ExtendedProblem& problem)
      : vehicle_(vehicle), p_(p), problem_(problem) {}

  int direction(const std::string& name) {
    const auto at = std::ranges::find(problem_.constants, name, &FreeConstant::name);
    if (at != problem_.constants.end()) return static_cast<int>(at - problem_.constants.begin());
    problem_.constants.push_back(effect_constant(name, vehicle_, p_));
    return static_cast<int>(problem_.constants.size()) - 1;
  }

  void effect(const std::string& name, const std::vector<std::string>& parameters, bool positive = false,
              int rotor = -1) {
    Candidate c{name, {}, -1, rotor, positive};
    for (const std::string& q : parameters) c.directions.push_back(direction(q));
    problem_.candidates.push_back(c);
  }

 private:
  const Vehicle& vehicle_;
  const std::vector<double>& p_;
  ExtendedProblem& problem_;
};

// A centre of gravity shifted along z alone turns the vehicle where something pushes from the side, as any
// gust does that pushes above it: more than this share of a payload's reach is taken for that.
constexpr double kHighest = 0.05;

}  // namespace

bool is_constant_of(const Candidate& cause, const FreeConstant& constant, int i) {
  if (cause.parameter >= 0) return cause.parameter == i;
  const std::string& name = constant.name;
  const std::size_t at = name.find('@');
  const bool rotor = at == std::string::npos || std::stoi(name.substr(at + 1)) == cause.rotor + 1;
  return rotor && name.substr(0, name.find('.')) == cause.name;
}

double value_without(const Candidate& cause, const FreeConstant& constant) {
  return cause.parameter >= 0 ? constant.prior_value : find_parameter(constant.name)->null_value;
}

double payload_reach(const Vehicle& vehicle) {
  double farthest = 0;
  for (const Rotor& rotor : vehicle.rotors) farthest = std::max(farthest, rotor.r_B.norm());
  return 2 * farthest;
}

bool states_effect(const Vehicle& vehicle, std::string_view effect) {
  const std::string prefix = std::string(effect) + ".";
  return std::ranges::any_of(vehicle.parameters,
                             [&](const auto& entry) { return entry.first.starts_with(prefix); });
}

bool states_constant(const Vehicle& vehicle, std::string_view name) {
  const std::string_view effect = name.substr(0, name.find('.') + 1);
  const auto rotor = [](std::string_view of) {
    const std::size_t at = of.find('@');
    return at == std::string_view::npos ? std::string_view() : of.substr(at);
  };
  return std::ranges::any_of(vehicle.parameters, [&](const auto& entry) {
    return entry.first.starts_with(effect) && rotor(entry.first) == rotor(name);
  });
}

ExtendedProblem extended_problem(const Vehicle& vehicle, const std::vector<double>& p, const Signals& signals,
                                 const std::vector<FreeConstant>& base,
                                 const std::vector<std::string>& exclude) {
  ExtendedProblem problem;
  problem.constants = base;
  problem.base = static_cast<int>(base.size());
  const auto wanted = [&](const std::string& name) {
    return std::ranges::find(exclude, name) == exclude.end();
  };
  Builder build(vehicle, p, problem);
  const bool moves = signals.velocity || signals.position;
  for (int i = 0; i < problem.base; ++i) {
    const FreeConstant& c = base[static_cast<std::size_t>(i)];
    const bool rival_effect = c.index == param::Jp && vehicle.signs == Signs::as_published;
    if (c.prior_std && c.name.find('.') == std::string::npos && !rival_effect &&
        wanted("parameter:" + c.name))
      problem.candidates.push_back({"parameter:" + c.name, {}, i, -1, false});
    // A rotor whose thrust is known to some per cent may have lost more: then that is the cause.
    if (c.prior_std && !c.adopted && is_rotor_ratio(c.name) && wanted("rotor_mismatch"))
      problem.candidates.push_back(
          {"rotor_mismatch", {}, i, std::stoi(c.name.substr(kRotorRatio.size())) - 1, false});
  }
  for (const EffectEntry& e : catalogue()) {
    const std::string name(e.info.name);
    const auto is = [&](EffectId id) { return e.id == id; };
    const bool at_rotors = is(EffectId::rotor_mismatch) || is(EffectId::rotor_tilt);
    if (!wanted(name) || (!at_rotors && states_effect(vehicle, name))) continue;
    const bool flow = (e.info.touches & kTouchFlow) != 0;
    if (at_rotors) {  // one that is stated says nothing of the others
      const auto unless_stated = [&](const std::vector<std::string>& names, int rotor) {
        if (!states_constant(vehicle, names.front())) build.effect(name, names, false, rotor);
      };
      if (is(EffectId::rotor_tilt)) unless_stated({"rotor_tilt.x", "rotor_tilt.y"}, -1);
      for (std::size_t k = 1; k <= vehicle.rotors.size(); ++k) {
        const std::string at = "@" + std::to_string(k);
        if (is(EffectId::rotor_mismatch))
          unless_stated({rotor_ratio(k)}, static_cast<int>(k) - 1);
        else
          unless_stated({"rotor_tilt.x" + at, "rotor_tilt.y" + at}, static_cast<int>(k) - 1);
      }
    } else if (is(EffectId::battery_sag)) {
      if (signals.commands)
        build.effect(name, {signals.voltage ? "battery_sag.n" : "battery_sag.rate"}, true);
    } else if (is(EffectId::motor_delay) || is(EffectId::motor_asymmetry)) {
      const bool stated = is(EffectId::motor_delay) && p[param::dead_time] > 0;
      if (signals.commands && !stated)
        build.effect(name, {name + (is(EffectId::motor_delay) ? ".tau" : ".ratio")},
                     is(EffectId::motor_delay));
    } else if (is(EffectId::payload)) {
      // At zero mass its place has no effect: to first order a payload is mass and a shifted centre of
      // gravity. One that was taken up is what it is.
      if (std::ranges::find(base, "payload.m", &FreeConstant::name) != base.end())
        build.effect(name, {"payload.m", "payload.x", "payload.y", "payload.z"}, true);
      else
        build.effect(name, {"payload.m", "cg_offset.x", "cg_offset.y", "cg_offset.z"}, true),
            problem.candidates.back().mass_for_shift =
                payload_reach(vehicle) > 0 ? p[param::m] / payload_reach(vehicle) : 0.0;
    } else if (is(EffectId::wind)) {
      const bool drag = p[static_cast<std::size_t>(find_parameter("rotor_drag.kd")->index)] != 0 ||
                        p[static_cast<std::size_t>(find_parameter("parasitic_drag.C")->index)] != 0;
      if (moves && drag) build.effect(name, {"wind.north", "wind.east"});
    } else if (is(EffectId::ground_effect)) {
      if (signals.position) build.effect(name, {"ground_effect.radius_sq"}, true);
    } else if (is(EffectId::gyroscopic)) {
      const bool stated =
          std::ranges::any_of(base, [](const FreeConstant& c) { return c.index == param::Jp; });
      if (!stated || vehicle.signs == Signs::as_published) build.effect(name, {"gyroscopic.Jp"});
    } else if (is(EffectId::imu_bias) || is(EffectId::imu_lever_arm)) {
      if (!signals.force) continue;
      std::vector<std::string> names;
      for (const EffectParameter& q : e.parameters) names.push_back(name + "." + std::string(q.name));
      build.effect(name, names);
    } else {
      if (flow && !moves) continue;
      if (is(EffectId::sensor_delay) && !signals.rates && !signals.attitude) continue;
      std::vector<std::string> names;
      for (const EffectParameter& q : e.parameters) names.push_back(name + "." + std::string(q.name));
      build.effect(name, names, e.parameters.size() == 1 && e.parameters[0].range == Range::positive);
    }
  }
  for (Candidate& c : problem.candidates)
    for (const int i : c.directions)
      if (problem.constants[static_cast<std::size_t>(i)].name == "cg_offset.z")
        c.height = i, c.highest = kHighest * payload_reach(vehicle);
  return problem;
}

std::vector<FreeConstant> constants_of(const Candidate& candidate, const Vehicle& vehicle,
                                       const std::vector<double>& p, bool voltage) {
  std::vector<FreeConstant> out;
  if (candidate.parameter >= 0) return out;
  if (candidate.name == "payload") {
    // Along mass and place the fit would follow a bent valley, along mass and moment it does not.
    for (const char* q : {"m", "x", "y", "z"}) {
      out.push_back(effect_constant(std::string("payload.") + q, vehicle, p));
      if (out.size() > 1) out.back().times = out.front().index;
    }
    return out;
  }
  const std::string at = candidate.rotor >= 0 ? "@" + std::to_string(candidate.rotor + 1) : "";
  for (const EffectParameter& q : find_effect(candidate.name)->parameters) {
    const std::string name(q.name);
    const bool numbered = name.find('@') != std::string::npos;
    if (candidate.name == "rotor_mismatch" || candidate.name == "rotor_tilt") {
      if (at.empty() ? numbered : name.size() < at.size() || name.substr(name.size() - at.size()) != at)
        continue;
    }
    if (candidate.name == "wind" && name == "down") continue;
    if (candidate.name == "battery_sag" && (name == "n") != voltage) continue;
    out.push_back(effect_constant(candidate.name + "." + name, vehicle, p));
  }
  return out;
}

}  // namespace ident
