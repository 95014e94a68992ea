// Which constants a log can tell, by what was logged.
#include "ident/flight/ladder/rungs.h"

#include <algorithm>
#include <limits>

namespace ident {
namespace {

constexpr double kGroundReach = 10.0;  // lengths of an arm: a rotor's radius is at most about one of them

// The lowest flight over the ground in lengths of the longest arm.
double lowest_in_arms(const MeasuredMotion& motion) {
  const Vehicle& vehicle = *motion.record->vehicle;
  double arm = 0, lowest = std::numeric_limits<double>::infinity();
  for (const Rotor& rotor : vehicle.rotors) arm = std::max(arm, rotor.r_B.head<2>().norm());
  for (const MeasuredArc& arc : motion.arcs)
    for (const BodyState<double>& body : arc.body) lowest = std::min(lowest, vehicle.ground_z - body.x_W[2]);
  return lowest / arm;
}

}  // namespace

std::vector<RungModel> rungs_for(const MeasuredMotion& motion) {
  std::vector<RungModel> all;
  const Signals& logged = motion.record->signals;
  const bool commands_alone = logged.commands && !logged.rotor_speeds;
  const bool sags = logged.commands && logged.voltage;
  if (motion.speeds) {
    all.push_back({Rung::motors, FitTo::speeds, {"km", "omega_m", "Omega_0"}});
    if (sags) all.push_back({Rung::battery, FitTo::speeds, {"battery_sag.n"}});
  }
  if (motion.forces) {
    all.push_back({Rung::thrust, FitTo::forces, {"m", "kT"}});
    if (commands_alone) all.back().constants.emplace_back("km");
  }
  if (motion.velocity) all.push_back({Rung::drag, FitTo::forces, {"rotor_drag.kd"}});
  if (motion.forces && commands_alone && sags)
    all.push_back({Rung::battery, FitTo::forces, {"battery_sag.n"}});
  if (motion.forces && logged.position && lowest_in_arms(motion) < kGroundReach)
    all.push_back({Rung::ground, FitTo::forces, {"ground_effect.radius_sq"}});
  if (motion.velocity)
    all.push_back(
        {Rung::air, FitTo::forces, {"axial_inflow.kz", "translational_lift.kh", "parasitic_drag.C"}});
  if (motion.forces && commands_alone)
    all.push_back({Rung::curve, FitTo::forces, {"thrust_curve.c", "thrust_curve.offset"}});
  if (motion.moments) {
    all.push_back({Rung::trim, FitTo::moments, {"cg_offset.x", "cg_offset.y"}});
    if (motion.velocity) all.back().constants.emplace_back("blade_flapping.kf");
    all.push_back({Rung::inertia, FitTo::moments, {"Jxx", "Jyy", "Jzz", "kQ"}});
  }
  return all;
}

}  // namespace ident
