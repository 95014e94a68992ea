// More rotors than the motion tells of one by one: what stands in for the speeds that nothing tells is no
// information on the constants.
#include <gtest/gtest.h>

#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/sim/simulate.h"
#include "support/ring_of_rotors.h"

namespace ident {
namespace {

// Speeds that nobody measures are known up to a scale: thrust is kT km^2, and what is known of the two apart
// comes from the bench. With all stated to a tenth, and kT km^2, kQ km^2 and Jp km told exactly,
//   std(km)/km = 0.1/sqrt(1 + 4 + 4 + 1) = 0.0316 ,  std(kT)/kT = 2 std(km)/km
// whatever the number of rotors.
TEST(ManyRotors, WithoutSpeedsTheirScaleIsNotDetermined) {
  for (const int rotors : {4, 6, 8}) {
    const Vehicle truth = testing::ring_of_rotors(rotors);
    SimulationOptions options;
    options.scenario = "mixed", options.duration = 15, options.seed = 11, options.rate = 200;
    options.longest_step = 0;
    FlightLog log = simulate_flight(truth, options).log;
    log.Omega.clear();
    Vehicle stated = truth;
    for (auto& [name, p] : stated.parameters) p.std = (name == "m" ? 1e-4 : 0.1) * p.value;
    stated.parameters["km"].value *= 1.1, stated.parameters["kT"].value /= 1.15;
    const Result result = refine_flight(stated, std::span(&log, 1), {.validate = false});
    const Parameter *kT = result.find("kT"), *km = result.find("km");
    EXPECT_NEAR(km->std / km->value, 0.0316, 0.003) << rotors;
    EXPECT_NEAR(kT->std / kT->value, 0.0632, 0.006) << rotors;
    EXPECT_NEAR(kT->value * km->value * km->value, truth.value("kT") * std::pow(truth.value("km"), 2),
                0.01 * 6e-6 * 900 * 900)
        << rotors;
  }
}

}  // namespace
}  // namespace ident
