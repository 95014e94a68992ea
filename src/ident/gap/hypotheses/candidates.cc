// Lists the causes for a vehicle and the signals that its logs have.
#include "ident/gap/hypotheses/candidates.h"

#include <algorithm>
#include <utility>

#include "ident/effects/all_parameters.h"
#include "ident/effects/typical_scale.h"
#include "ident/flight/trim/trim.h"

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

// A centre of gravity shifted along z alone turns the vehicle where something pushes from the side, as any
// gust does that pushes above it: more than this share of a payload's reach is taken for that.
constexpr double kHighest = 0.05;

using Names = std::vector<std::string>;

// Takes up the causes of a vehicle one after the other; what its file states is part of the model.
class Builder {
 public:
  Builder(const Vehicle& vehicle, const std::vector<double>& p, const Signals& signals,
          const std::vector<FreeConstant>& base, const Names& exclude)
      : vehicle_(vehicle), p_(p), signals_(signals), exclude_(exclude) {
    problem_.constants = base;
    problem_.base = static_cast<int>(base.size());
  }

  // That the value of base constant i is wrong.
  void add_value(int i) {
    const FreeConstant& c = problem_.constants[static_cast<std::size_t>(i)];
    const bool rival_effect = c.index == param::Jp && vehicle_.signs == Signs::as_published;
    const bool at_rotor = c.name.find('@') != std::string::npos;  // its effect names the rotor, below
    if (c.prior_std && !c.adopted && !at_rotor && !rival_effect && wanted("parameter:" + c.name))
      problem_.candidates.push_back({"parameter:" + c.name, {}, i, -1, false});
    // A rotor whose thrust is known to some per cent may have lost more: then that is the cause.
    if (c.prior_std && !c.adopted && is_rotor_ratio(c.name) && wanted("rotor_mismatch"))
      problem_.candidates.push_back(
          {"rotor_mismatch", {}, i, std::stoi(c.name.substr(kRotorRatio.size())) - 1, false});
  }

  void add_effect(const EffectEntry& e) {
    const std::string name(e.info.name);
    if (!wanted(name)) return;
    if (e.id == EffectId::rotor_mismatch || e.id == EffectId::rotor_tilt)
      add_at_rotors(e.id);
    else if (states_effect(vehicle_, name) || !can_show(e))
      return;
    else if (e.id == EffectId::payload)
      add_payload();
    else if (e.id == EffectId::battery_sag)
      add(name, {signals_.voltage ? "battery_sag.n" : "battery_sag.rate"}, true);
    else if (e.id == EffectId::wind)
      add(name, {"wind.north", "wind.east"});
    else
      add(name, all_of(e), e.parameters.size() == 1 && e.parameters[0].range == Range::positive);
  }

  ExtendedProblem end() {
    for (Candidate& c : problem_.candidates)
      for (const int i : c.directions)
        if (problem_.constants[static_cast<std::size_t>(i)].name == "cg_offset.z")
          c.height = i, c.highest = kHighest * payload_reach(vehicle_);
    return std::move(problem_);
  }

 private:
  bool wanted(const std::string& name) const { return std::ranges::find(exclude_, name) == exclude_.end(); }

  bool is_base(int index) const {
    const auto end = problem_.constants.begin() + problem_.base;
    return std::find_if(problem_.constants.begin(), end,
                        [&](const FreeConstant& c) { return c.index == index; }) != end;
  }

  double value(const char* name) const { return p_[static_cast<std::size_t>(find_parameter(name)->index)]; }

  // Whether these signals can show it at all, and no constant of the vehicle is the same thing.
  bool can_show(const EffectEntry& e) const {
    if ((e.info.touches & kTouchFlow) != 0 && !signals_.velocity && !signals_.position) return false;
    switch (e.id) {
      case EffectId::battery_sag:
      case EffectId::motor_asymmetry:
        return signals_.commands;
      case EffectId::motor_delay:
        return signals_.commands && !(p_[param::dead_time] > 0);
      case EffectId::wind:  // acts through drag
        return value("rotor_drag.kd") != 0 || value("parasitic_drag.C") != 0;
      case EffectId::ground_effect:
        return signals_.position;
      case EffectId::gyroscopic:
        return !is_base(param::Jp) || vehicle_.signs == Signs::as_published;
      case EffectId::imu_bias:
      case EffectId::imu_lever_arm:
        return signals_.force;
      case EffectId::sensor_delay:
        return signals_.rates || signals_.attitude;
      default:
        return true;
    }
  }

  static Names all_of(const EffectEntry& e) {
    Names names;
    for (const EffectParameter& q : e.parameters)
      names.push_back(std::string(e.info.name) + "." + std::string(q.name));
    return names;
  }

  // One that is stated says nothing of the others.
  void add_at_rotors(EffectId id) {
    const auto unless_stated = [&](const Names& names, int rotor) {
      const std::string& first = names.front();
      if (!states_constant(vehicle_, first)) add(first.substr(0, first.find('.')), names, false, rotor);
    };
    if (id == EffectId::rotor_tilt) unless_stated({"rotor_tilt.x", "rotor_tilt.y"}, -1);
    for (std::size_t k = 1; k <= vehicle_.rotors.size(); ++k) {
      const std::string at = "@" + std::to_string(k);
      const Names names = id == EffectId::rotor_mismatch ? Names{rotor_ratio(k)}
                                                         : Names{"rotor_tilt.x" + at, "rotor_tilt.y" + at};
      unless_stated(names, static_cast<int>(k) - 1);
    }
  }

  // At zero mass its place has no effect: to first order a payload is mass and a shifted centre of gravity.
  // One that was taken up is what it is.
  void add_payload() {
    if (is_base(find_parameter("payload.m")->index)) {
      add("payload", {"payload.m", "payload.x", "payload.y", "payload.z"}, true);
      return;
    }
    add("payload", {"payload.m", "cg_offset.x", "cg_offset.y", "cg_offset.z"}, true);
    const double reach = payload_reach(vehicle_);
    problem_.candidates.back().mass_for_shift = reach > 0 ? p_[param::m] / reach : 0.0;
  }

  void add(const std::string& name, const Names& parameters, bool positive = false, int rotor = -1) {
    Candidate c{name, {}, -1, rotor, positive};
    for (const std::string& q : parameters) c.directions.push_back(direction(q));
    problem_.candidates.push_back(c);
  }

  int direction(const std::string& name) {
    const auto at = std::ranges::find(problem_.constants, name, &FreeConstant::name);
    if (at != problem_.constants.end()) return static_cast<int>(at - problem_.constants.begin());
    problem_.constants.push_back(effect_constant(name, vehicle_, p_));
    return static_cast<int>(problem_.constants.size()) - 1;
  }

  const Vehicle& vehicle_;
  const std::vector<double>& p_;
  const Signals& signals_;
  const Names& exclude_;
  ExtendedProblem problem_;
};

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

Vehicle with_doubted_effects(Vehicle vehicle) {
  constexpr double kDigits = 0.02;  // two of them
  for (auto& [name, known] : vehicle.parameters) {
    const EffectParameter* size = find_effect_parameter(name);
    if (size && known.value != size->null_value && !known.std)
      known.std = kDigits * std::abs(known.value - size->null_value);
  }
  return vehicle;
}

ExtendedProblem extended_problem(const Vehicle& vehicle, const std::vector<double>& p, const Signals& signals,
                                 const std::vector<FreeConstant>& base,
                                 const std::vector<std::string>& exclude) {
  Builder build(vehicle, p, signals, base, exclude);
  for (int i = 0; i < static_cast<int>(base.size()); ++i) build.add_value(i);
  for (const EffectEntry& e : catalogue()) build.add_effect(e);
  return build.end();
}

std::vector<FreeConstant> constants_of(const Candidate& candidate, const Vehicle& vehicle,
                                       const std::vector<double>& p, const Signals& signals) {
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
    if (candidate.name == "battery_sag" && (name == "n") != signals.voltage) continue;
    out.push_back(effect_constant(candidate.name + "." + name, vehicle, p));
    // Of rotors whose speed is not measured, commands tell what turns with them only times km.
    const bool by_commands = signals.commands && !signals.rotor_speeds;
    if (by_commands && q.unit.ends_with("/rad")) out.back().times = param::km;
  }
  return out;
}

}  // namespace ident
