// Rows of a trifilar pendulum.
//
//   J = J_vehicle + J_platform + (m_v m_p/m) offset^2 ,   m = m_v + m_p
//   r^2 = radius^2 - c^2 ,   c = m_v offset/m
//
// about the common centre of gravity, with the exact period of model/trifilar_period.h; the inverse of what
// the file format states.
#include "ident/sim/simulate_inertia.h"

#include <algorithm>
#include <array>

#include "ident/core/error.h"
#include "ident/core/random.h"
#include "ident/model/trifilar_period.h"

namespace ident {
namespace {

/// What hangs on the wires.
struct Hung {
  const char* axis;
  double mass, offset;  ///< kg; of the vehicle, m
  double J, c_squared;  ///< kg m^2 about the common centre of gravity; m^2
};

double needed(const Vehicle& vehicle, const char* name) {
  if (vehicle.has(name) && vehicle.value(name) > 0.0) return vehicle.value(name);
  throw UsageError((vehicle.file.empty() ? std::string("vehicle") : vehicle.file) + ": " + name +
                   ": a positive value is needed to swing it");
}

double farthest_hub(const Vehicle& vehicle) {
  double reach = vehicle.arm.value_or(0.0);
  for (const Rotor& rotor : vehicle.rotors) reach = std::max(reach, rotor.r_B.norm());
  if (!(reach > 0.0)) throw UsageError("radius: the vehicle file has no rotors to take it from, state it");
  return reach;
}

std::array<Hung, 4> hung(const Vehicle& vehicle, const PendulumSwings& options, double radius) {
  const double m_v = needed(vehicle, "m"),
               m_p = options.platform_mass > 0.0 ? options.platform_mass : m_v / 3.0;
  const double m = m_v + m_p, J_platform = 0.5 * m_p * radius * radius;  // a disc
  const double c = m_v * options.offset / m, J_off = m_v * m_p / m * options.offset * options.offset;
  const auto with = [&](const char* axis, const char* J) {
    return Hung{axis, m, options.offset, needed(vehicle, J) + J_platform + J_off, c * c};
  };
  return {Hung{"platform", m_p, 0.0, J_platform, 0.0}, with("x", "Jxx"), with("y", "Jyy"), with("z", "Jzz")};
}

}  // namespace

NumberTable simulate_inertia(const Vehicle& vehicle, const PendulumSwings& options) {
  const double radius = options.radius > 0.0 ? options.radius : 1.2 * farthest_hub(vehicle);
  if (options.repeats < 1) throw UsageError("each axis needs at least one row");
  if (!(options.length > 2.0 * radius * std::sin(0.5 * options.amplitude)) || !(options.amplitude >= 0.0) ||
      options.amplitude > 2.0)
    throw UsageError("wires this short do not allow this amplitude");
  if (!(std::abs(options.offset) < radius)) throw UsageError("offset: has to lie within the wires");
  Random random(options.seed);
  BenchSensor watch(options.noise, {.outliers = options.outliers}, random);
  NumberTable table{.file = "pendulum.csv", .text = {{.name = "axis", .values = {}}}};
  std::vector<double> period, mass, radii, lengths, offsets, amplitudes;
  for (const Hung& body : hung(vehicle, options, radius)) {
    const TrifilarSuspension suspension{.mass = body.mass,
                                        .gravity = vehicle.g,
                                        .radius_squared = radius * radius - body.c_squared,
                                        .length = options.length,
                                        .amplitude = options.amplitude};
    const double T = trifilar_period(suspension, body.J).period;
    for (int i = 0; i < options.repeats; ++i) {
      table.text.front().values.push_back(body.axis);
      period.push_back(watch(T)), mass.push_back(body.mass), radii.push_back(radius);
      lengths.push_back(options.length), offsets.push_back(body.offset),
          amplitudes.push_back(options.amplitude);
      table.line.push_back(static_cast<long>(period.size()) + 1);
    }
  }
  table.columns = {{"period", "period", period},
                   {"mass", "mass", mass},
                   {"radius", "radius", radii},
                   {"length", "length", lengths}};
  if (options.offset != 0.0) table.columns.push_back({"offset", "offset", offsets});
  if (options.amplitude > 0.0) table.columns.push_back({"amplitude", "amplitude", amplitudes});
  return table;
}

}  // namespace ident
