// Motors that are over with a change before the next row, of which no row tells how their speed changed.
#include <gtest/gtest.h>

#include "ident/flight/refine.h"
#include "ident/flight/verify.h"
#include "ident/gap/diagnose.h"
#include "support/known_quad.h"

namespace ident {
namespace {

// Close to first order, with a time constant of 5 ms; the second pole is that many times as fast.
Vehicle fast(double zeta) {
  Vehicle v = testing::quad(0.0);
  v.parameters.erase("Jp");  // with it steps of a row are too long for a diagnosis, not for a simulation
  const double times = std::pow(zeta + std::sqrt(zeta * zeta - 1), 2);
  v.parameters["zeta_m"] = {zeta, {}};
  v.parameters["omega_m"] = {std::sqrt(times) / 0.005, {}};
  return v;
}

Vehicle a_little_off(Vehicle v) {
  v = testing::known(v);
  v.parameters["zeta_m"].std = 0.01 * v.value("zeta_m");
  double sign = 1;
  for (const char* name : {"kT", "Jxx", "Jyy", "omega_m"})
    v.parameters[name].value *= 1 + 0.05 * sign, sign = -sign;
  return v;
}

FlightLog without_speeds(const Vehicle& v) {
  SimulationOptions options;
  options.duration = 30.0, options.rate = 200.0, options.signals.rotor_speeds = 0;
  return simulate_flight(v, options).log;
}

TEST(FastMotors, ASimulationFromTheLogDoesNotDiverge) {
  for (const double zeta : {1.5, 5.0, 20.0, 100.0}) {
    const Vehicle truth = fast(zeta);
    const Result result =
        verify_flight(a_little_off(truth), std::vector<FlightLog>{without_speeds(truth)}, 1.0);
    EXPECT_EQ(result.verdict.find("ran away"), std::string::npos) << zeta << ": " << result.verdict;
    EXPECT_LT(result.fit["channels"]["az"]["rms"].get<double>(), 2.0) << zeta;
  }
}

TEST(FastMotors, NoCauseIsFoundInAFlightWithoutEffect) {
  for (const double zeta : {1.5, 20.0}) {
    const Vehicle truth = fast(zeta);
    const Diagnosis found = diagnose_gap(a_little_off(truth), std::vector<FlightLog>{without_speeds(truth)});
    EXPECT_EQ(found.result.extra["verdict"]["status"], "none") << zeta << found.result.extra["verdict"];
    EXPECT_LT(found.result.extra["gap"]["after"].get<double>(), 1.1) << zeta;
  }
}

}  // namespace
}  // namespace ident
