// Where the mass is: the choice of origin changes no motion, and a payload is a second body bolted on.
#include <gtest/gtest.h>

#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"
#include "support/random_vehicle.h"
#include "support/restless_commands.h"

namespace ident {
namespace {

using testing::restless_commands;
using Vector = Vec3<double>;

/// Half a second of flight with the vehicle's effects.
FlightState<double> flown(const Vehicle& vehicle, FlightState<double> x) {
  const std::vector<double> p = parameter_vector(vehicle);
  const EffectSet<double> effects(p, active_effects(p));
  const FlightInputs inputs = restless_commands(vehicle.rotors.size());
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, inputs);
  constexpr double h = 1e-3;
  for (int i = 0; i < 500; ++i) x = flight.step(x, i * h, h, flight.rate(x, i * h));
  return x;
}

/// Motion of the point `r_B` of a vehicle whose origin moves as `x`.
FlightState<double> seen_from(FlightState<double> x, const Vector& r_B) {
  const Mat3<double> R_WB = rotation(x.body.q_WB);
  x.body.v_W += R_WB * cross(x.body.w_B, r_B);
  x.body.x_W += R_WB * r_B;
  return x;
}

// Equations (5) and (6): moments about the centre of gravity, and the motion of an origin off it.
TEST(MassLaws, TheOriginMayLieAnywhereInTheBody) {
  const Vector c(0.013, -0.008, 0.021);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Vehicle centred = random_vehicle(seed);
    centred.parameters["Jxz"] = {0.05 * centred.value("Jxx"), {}};
    centred.parameters["rotor_drag.kd"] = {1e-5, {}};  // at the hubs, with their velocity
    Vehicle shifted = centred;
    for (Rotor& rotor : shifted.rotors) rotor.r_B += c;
    for (const auto& [name, value] :
         {std::pair{"cg_offset.x", c[0]}, {"cg_offset.y", c[1]}, {"cg_offset.z", c[2]}})
      shifted.parameters[name] = {value, {}};
    FlightState<double> start;
    start.body = {Vec4<double>(0.9, 0.2, -0.3, 0.25).normalized(), Vector(1.0, -2.0, 0.7),
                  Vector(1.0, 2.0, -0.5), Vector(0.3, 0.1, -20.0)};
    for (auto& motor : start.motors) motor = {0.5 * centred.value("km"), 0.0};
    const FlightState<double> a = flown(centred, start),
                              b = seen_from(flown(shifted, seen_from(start, -c)), c);
    EXPECT_LT((a.body.w_B - b.body.w_B).norm(), 1e-8 * (1 + a.body.w_B.norm())) << centred.name;
    EXPECT_LT((a.body.q_WB - b.body.q_WB).norm(), 1e-8) << centred.name;
    EXPECT_LT((a.body.v_W - b.body.v_W).norm(), 1e-8 * (1 + a.body.v_W.norm())) << centred.name;
    EXPECT_LT((a.body.x_W - b.body.x_W).norm(), 1e-8 * (1 + a.body.x_W.norm())) << centred.name;
  }
}

TEST(MassLaws, APayloadIsASecondBodyBoltedOn) {
  Vehicle vehicle = random_vehicle(5);
  const Vector r(0.04, -0.03, 0.06);
  const double m = vehicle.value("m"), m_p = 0.2 * m;
  const Mat3<double> J =
      Vector(vehicle.value("Jxx"), vehicle.value("Jyy"), vehicle.value("Jzz")).asDiagonal();
  vehicle.parameters["payload.m"] = {m_p, {}};
  for (const auto& [name, value] : {std::pair{"payload.x", r[0]}, {"payload.y", r[1]}, {"payload.z", r[2]}})
    vehicle.parameters[name] = {value, {}};
  const std::vector<double> p = parameter_vector(vehicle);
  const EffectSet<double> effects(p, active_effects(p));
  const Body<double, EffectSet<double>> body(vehicle, p, effects);
  // Both bodies about the common centre of gravity, each by the parallel axis theorem.
  const Vector c = m_p / (m + m_p) * r;
  const auto moved = [](double mass, const Vector& d) {
    return Mat3<double>(mass * (d.squaredNorm() * Mat3<double>::Identity() - d * d.transpose()));
  };
  EXPECT_NEAR(body.mass(), m + m_p, 1e-15);
  EXPECT_LT((body.centre_of_gravity() - c).norm(), 1e-16);
  EXPECT_LT((body.J() - (J + moved(m, c) + moved(m_p, r - c))).norm(), 1e-15);
}

}  // namespace
}  // namespace ident
