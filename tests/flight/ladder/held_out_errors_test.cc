// The model that flew predicts held-out flight down to the noise of the sensors, however rows lie in time.
#include "ident/flight/ladder/held_out_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/flight/make_record.h"
#include "ident/flight/record/excerpts.h"
#include "support/known_quad.h"

namespace ident {
namespace {

FlightLog commanded(double rate) {
  SimulationOptions options;
  options.rate = rate, options.duration = 20, options.seed = 4, options.by_gyro = true;
  options.signals.rotor_speeds = 0;
  return simulate_flight(testing::quad(0.0), options).log;
}

// The same samples; rows of the voltage alone lie 20 us after each.
FlightLog with_rows_between(const FlightLog& log) {
  FlightLog out = log;
  out.t.clear(), out.vbat.clear();
  for (const double t : log.t) {
    out.t.insert(out.t.end(), {t, t + 20e-6});
    out.vbat.insert(out.vbat.end(), {kNaN, 12.0});
  }
  const auto spread = [](auto& columns) {
    for (std::vector<double>& column : columns) {
      std::vector<double> rows;
      for (const double y : column) rows.insert(rows.end(), {y, kNaN});
      column = rows;
    }
  };
  spread(out.delta), spread(out.w_B), spread(out.f_B), spread(out.q_WB), spread(out.x_W), spread(out.v_W);
  for (std::vector<double>& delta : out.delta)
    for (std::size_t i = 1; i < delta.size(); i += 2) delta[i] = delta[i - 1];
  return out;
}

double error_over_floor(const FlightLog& log) {
  const Vehicle vehicle = testing::quad(0.0);
  const std::vector<FlightLog> logs{log};
  const std::vector<double> p = parameter_vector(vehicle);
  const FlightRecord record = make_flight_record(vehicle, p, logs), held_out = held_out_of(record, 0.7);
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) square += 2 * std::pow(record.sigma[kGyro + k], 2);
  const auto windows = held_out_errors(measured_motion(held_out), p);
  EXPECT_GE(windows.size(), 8U);
  return error_of(windows, Metric::rate, 0) / std::sqrt(square);
}

// Motors start where the commands before the held-out part leave them, and count with their mean thrust
// between rows.
TEST(HeldOutErrors, OfTheModelThatFlewAreNoise) {
  for (const double rate : {250.0, 500.0}) EXPECT_LT(error_over_floor(commanded(rate)), 1.3) << rate;
}

TEST(HeldOutErrors, DoNotHangOnRowsThatOtherStreamsMake) {
  const FlightLog log = commanded(250), between = with_rows_between(log);
  EXPECT_LT(error_over_floor(between), 1.3);
  const Vehicle vehicle = testing::quad(0.0);
  const FlightRecord record =
      make_flight_record(vehicle, parameter_vector(vehicle), std::vector<FlightLog>{between});
  EXPECT_NEAR(record.interval, 0.004, 1e-5);
  const MeasuredMotion motion = measured_motion(record);
  EXPECT_GT(motion.arcs[0].t.size(), 1500U);
  for (std::size_t i = 1; i < motion.arcs[0].t.size(); ++i)
    EXPECT_NEAR(motion.arcs[0].t[i] - motion.arcs[0].t[i - 1], 0.01, 0.0025);
}

}  // namespace
}  // namespace ident
