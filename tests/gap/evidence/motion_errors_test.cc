// Errors in the units of flight: those of noise for the model that flew, and null for what was not logged.
#include "ident/gap/evidence/motion_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/flight/make_record.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::quad;

constexpr double kBias = 0.3;  // rad/s

struct Case {
  Vehicle vehicle = quad();
  std::vector<double> truth = parameter_vector(vehicle), heavy = truth, weak = truth;
  Case() {
    heavy[param::m] *= 1.1;
    weak[param::Jxx] *= 2;
  }
  /// Errors of a model beside the true one; the gyro's bias is taken for known as `bias`.
  nlohmann::ordered_json errors(const FlightLog& log, const std::vector<double>& stated, double bias = 0.0) {
    const std::vector<FlightLog> logs{log};
    const FlightRecord record = make_flight_record(vehicle, truth, logs);
    return motion_errors(record, {stated, truth, {{bias, 0.0, 0.0}}, record.sigma});
  }
};

double value(const nlohmann::ordered_json& errors, const char* what, std::size_t horizon, const char* key) {
  return errors[what]["horizons"][horizon][key].get<double>();
}

// A vehicle that is a tenth lighter than stated climbs with a tenth of g more: 0.9 m/s after a second of
// hover.
TEST(MotionErrors, AWrongMassIsAVelocityThatIsMissed) {
  Case c;
  const auto errors = c.errors(flight(c.vehicle, 200, 3, 20), c.heavy);
  EXPECT_EQ(errors["forces"]["unit"], "m/s");
  EXPECT_EQ(errors["forces"]["horizons"][2]["seconds"], 1.0);
  EXPECT_NEAR(value(errors, "forces", 2, "before"), 9.81 * (1 - 1 / 1.1), 0.25);
  EXPECT_LT(value(errors, "forces", 2, "after"), 0.2);
  EXPECT_GT(value(errors, "forces", 2, "closed"), 0.95);
  EXPECT_NEAR(value(errors, "moments", 0, "before"), value(errors, "moments", 0, "after"), 1e-12);
}

TEST(MotionErrors, AWrongInertiaIsARateAndAnAttitudeThatAreMissed) {
  Case c;
  const auto errors = c.errors(flight(c.vehicle, 200, 3, 20), c.weak);
  for (const char* what : {"moments", "open_loop"})
    EXPECT_GT(value(errors, what, 1, "before"), 2 * value(errors, what, 1, "after")) << what;
  EXPECT_NEAR(value(errors, "forces", 2, "before"), value(errors, "forces", 2, "after"), 1e-12);
}

// The model that flew errs by the noise at both ends of a window, and by what noise of the motors adds.
TEST(MotionErrors, TheTrueModelIsAtTheFloor) {
  Case c;
  const auto errors = c.errors(flight(c.vehicle, 200, 3, 20), c.heavy);
  for (const char* what : {"forces", "moments"}) {
    const double ratio = value(errors, what, 0, "after") / value(errors, what, 0, "noise_floor");
    EXPECT_GT(ratio, 0.7) << what;
    EXPECT_LT(ratio, 2.0) << what;
  }
}

TEST(MotionErrors, TheBiasOfTheGyroIsNoErrorOfTheModel) {
  Case c;
  FlightLog log = flight(c.vehicle, 200, 3, 20);
  const double without = value(c.errors(log, c.heavy), "open_loop", 2, "after");
  for (double& p : log.w_B[0]) p += kBias;
  EXPECT_GT(value(c.errors(log, c.heavy), "open_loop", 2, "after"), without + 5.0);
  EXPECT_NEAR(value(c.errors(log, c.heavy, kBias), "open_loop", 2, "after"), without, 0.2);
}

TEST(MotionErrors, WhatWasNotLoggedIsNull) {
  Case c;
  FlightLog log = flight(c.vehicle, 200, 3, 20);
  log.q_WB = {};
  log.v_W = {}, log.x_W = {};
  const auto errors = c.errors(log, c.heavy);
  EXPECT_TRUE(errors["open_loop"].is_null());
  EXPECT_FALSE(errors["moments"].is_null());
  EXPECT_TRUE(errors["forces"]["horizons"][0]["closed"].is_null());  // no noise of a velocity is known
  log.f_B = {};
  EXPECT_TRUE(c.errors(log, c.heavy)["forces"].is_null());
}

}  // namespace
}  // namespace ident
