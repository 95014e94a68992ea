// Steps that are longer than motors take: what turns the body as rotors speed up is not lost.
#include <gtest/gtest.h>

#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"
#include "support/known_quad.h"

namespace ident {
namespace {

// Yaw rate after 40 ms, of a vehicle whose rotors of one sense are told to speed up at the start; steps of h.
double yaw_rate(const Vehicle& vehicle, double h, int order) {
  const std::vector<double> p = parameter_vector(vehicle);
  FlightInputs inputs;
  for (std::size_t n = 0; n < 4; ++n)
    inputs.delta.emplace_back(std::vector<double>{-1.0, 0.0},
                              std::vector<double>{0.5, vehicle.rotors[n].s > 0 ? 0.6 : 0.5});
  const NoEffects none;
  Flight<double> flight(vehicle, p, none, inputs);
  flight.step_to_order(order);
  FlightState<double> x{
      {Vec4<double>(1, 0, 0, 0), Vec3<double>::Zero(), Vec3<double>::Zero(), Vec3<double>(0, 0, -5)}, {}, {}};
  for (MotorState<double>& motor : x.motors) motor = {0.5 * vehicle.value("km"), 0.0};
  BodyRate<double> rate = flight.rate(x, 0.0);
  const int steps = static_cast<int>(std::lround(0.04 / h));
  for (int k = 0; k < steps; ++k) flight.step_on(x, k * h, h, rate);
  return x.body.w_B[2];
}

TEST(FastMotor, RotorsThatSpeedUpWithinAStepTurnTheBodyByAllOfIt) {
  for (const double zeta : {5.0, 50.0}) {
    Vehicle vehicle = testing::quad(0.0);
    const double slow = zeta + std::sqrt(zeta * zeta - 1);  // of its pole: a time constant of 5 ms
    vehicle.parameters["zeta_m"] = {zeta, {}}, vehicle.parameters["omega_m"] = {slow / 0.005, {}};
    const double truth = yaw_rate(vehicle, 1e-5, 4);
    for (const int order : {2, 4}) EXPECT_NEAR(yaw_rate(vehicle, 4e-3, order) / truth, 1.0, 2e-3) << zeta;
  }
}

}  // namespace
}  // namespace ident
