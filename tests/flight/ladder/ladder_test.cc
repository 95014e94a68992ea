// The ladder on simulated flight: what each rung finds, what filters do to it, and where it stops.
#include "ident/flight/ladder/ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/flight/make_record.h"
#include "ident/flight/prepare.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::quad;

/// A racing quadrotor's drag and inflow, by weight; no dead time.
Vehicle in_air() {
  Vehicle v = quad(0.0);
  v.parameters["rotor_drag.kd"].value = 2e-5, v.parameters["axial_inflow.kz"].value = 3e-5;
  return v;
}

/// Without the drag, and with a thrust that is 8 % off.
Vehicle as_stated(const Vehicle& truth) {
  Vehicle v = testing::known(truth);
  v.parameters["kT"].value *= 1.08;
  v.parameters.erase("rotor_drag.kd"), v.parameters.erase("axial_inflow.kz");
  return v;
}

/// The record of a log with all that it holds.
struct Both {
  Vehicle vehicle;
  FlightRecord record;

  Both(Vehicle stated, FlightLog log) : vehicle(std::move(stated)) {
    std::vector<Warning> warnings;
    const std::vector<FlightLog> logs{std::move(log)};
    record = make_flight_record(vehicle, starting_constants(vehicle, logs, warnings), logs);
  }
  Both(const Both&) = delete;
};

/// The same of rotor speeds without commands, or of commands where the log has no speeds.
struct Flown : Both {
  Flown(Vehicle stated, FlightLog log) : Both(std::move(stated), one_input(std::move(log))) {}

  static FlightLog one_input(FlightLog log) {
    if (log.has_rotor_speeds()) log.delta.clear();
    return log;
  }
};

const RungResult& rung_of(const LadderResult& ladder, Rung rung) {
  return *std::ranges::find(ladder.rungs, rung, &RungResult::rung);
}

void expect_found(const RungResult& rung, const std::string& name, double truth) {
  const auto found = std::ranges::find(rung.constants, name, &RungConstant::name);
  ASSERT_NE(found, rung.constants.end()) << name;
  EXPECT_NEAR(found->value, truth, 4 * found->std) << name;
  EXPECT_LT(found->std, 0.1 * truth) << name;
}

/// A sensor's low-pass of first order, s.
void filter(std::vector<double>& y, const std::vector<double>& t, double tau) {
  double now = y.front();
  for (std::size_t i = 1; i < y.size(); ++i) {
    now += (1 - std::exp(-(t[i] - t[i - 1]) / tau)) * (y[i] - now);
    y[i] = now;
  }
}

TEST(Ladder, FindsThrustDragAndInflow) {
  const Vehicle truth = in_air();
  const Flown flown(as_stated(truth), flight(truth, 100, 3));
  const auto ladder = climb_ladder(flown.record);
  ASSERT_TRUE(ladder);
  const RungResult& air = rung_of(*ladder, Rung::air);
  EXPECT_EQ(air.refusal, Refusal::none);
  expect_found(air, "kT", truth.value("kT"));
  expect_found(air, "rotor_drag.kd", truth.value("rotor_drag.kd"));
  expect_found(air, "axial_inflow.kz", truth.value("axial_inflow.kz"));
  const auto velocity = static_cast<std::size_t>(Metric::velocity);
  EXPECT_LT(air.error[velocity][1], 0.2 * rung_of(*ladder, Rung::stated).error[velocity][1]);
}

// Where commands and speeds were logged, each tells of the other, whatever thrust and inertia are.
TEST(Ladder, SpeedsForCommandsTellOfMotors) {
  const Vehicle truth = in_air();
  Vehicle stated = as_stated(truth);
  stated.parameters["km"].value *= 0.85, stated.parameters["omega_m"].value *= 1.3;
  stated.parameters["km"].std = 0.2 * truth.value("km");
  stated.parameters["omega_m"].std = 0.3 * truth.value("omega_m");
  const Both flown(stated, flight(truth, 100, 3));
  const auto ladder = climb_ladder(flown.record);
  ASSERT_TRUE(ladder);
  const RungResult& chosen = ladder->rungs[ladder->chosen];
  expect_found(chosen, "km", truth.value("km"));
  expect_found(chosen, "omega_m", truth.value("omega_m"));
  expect_found(chosen, "kT", truth.value("kT"));
  const auto speed = static_cast<std::size_t>(Metric::rotor_speed),
             open = static_cast<std::size_t>(Metric::open_velocity);
  const RungResult& first = rung_of(*ladder, Rung::stated);
  EXPECT_LT(chosen.error[speed][1], 0.3 * first.error[speed][1]);
  EXPECT_LT(chosen.error[open][1], 0.3 * first.error[open][1]);
}

// A thrust and a motor whose errors cancel where commands are the input: both are mended, or neither.
TEST(Ladder, MotorsAreNotMendedAlone) {
  const Vehicle truth = in_air();
  Vehicle stated = testing::known(truth);
  stated.parameters["km"].value *= 0.85, stated.parameters["km"].std = 0.2 * truth.value("km");
  stated.parameters["kT"].value /= 0.85 * 0.85, stated.parameters["kT"].std = 0.0;
  const Both flown(stated, flight(truth, 100, 3));
  const auto ladder = climb_ladder(flown.record);
  ASSERT_TRUE(ladder);
  const auto open = static_cast<std::size_t>(Metric::open_velocity);
  EXPECT_LE(ladder->rungs[ladder->chosen].error[open][1],
            1.2 * rung_of(*ladder, Rung::stated).error[open][1]);
}

// With attitude and velocity logged, the specific force is not asked for.
TEST(Ladder, AFilterOfTheAccelerometerChangesNothing) {
  const Vehicle truth = in_air();
  FlightLog log = flight(truth, 100, 3), filtered = log;
  for (auto& axis : filtered.f_B) filter(axis, filtered.t, 0.1);
  const Flown prompt(as_stated(truth), log), late(as_stated(truth), filtered);
  const auto a = climb_ladder(prompt.record), b = climb_ladder(late.record);
  ASSERT_TRUE(a && b);
  EXPECT_DOUBLE_EQ(rung_of(*a, Rung::air).p[param::kT], rung_of(*b, Rung::air).p[param::kT]);
}

TEST(Ladder, AFullModelThatIsTheTruthIsTaken) {
  const Vehicle truth = in_air();
  const Flown flown(as_stated(truth), flight(truth, 100, 3));
  const std::vector<double> p = parameter_vector(truth);
  auto ladder = climb_ladder(flown.record);
  judge_full(*ladder, flown.record, FullModel{p, p});
  ASSERT_TRUE(ladder);
  EXPECT_EQ(ladder->rungs[ladder->chosen].rung, Rung::full);
}

TEST(Ladder, AFullModelWithHalfTheThrustIsRefused) {
  const Vehicle truth = in_air();
  const Flown flown(as_stated(truth), flight(truth, 100, 3));
  std::vector<double> p = parameter_vector(truth);
  p[param::kT] *= 0.5;
  auto ladder = climb_ladder(flown.record);
  judge_full(*ladder, flown.record, FullModel{p, p});
  ASSERT_TRUE(ladder);
  EXPECT_NE(ladder->rungs[ladder->chosen].rung, Rung::full);
  EXPECT_EQ(ladder->rungs.back().refusal, Refusal::worse);
}

TEST(Ladder, AMassThatNoScaleWouldShowIsRefused) {
  const Vehicle truth = in_air();
  const Flown flown(as_stated(truth), flight(truth, 100, 3));
  std::vector<double> p = parameter_vector(truth);
  for (const int scaled : {param::m, param::kT, param::Jxx, param::Jyy, param::Jzz, param::kQ})
    p[static_cast<std::size_t>(scaled)] *= 0.9;  // flies the same
  auto ladder = climb_ladder(flown.record);
  judge_full(*ladder, flown.record, FullModel{p, p});
  ASSERT_TRUE(ladder);
  EXPECT_EQ(ladder->rungs.back().refusal, Refusal::beyond);
}

// Jxx of the rung where omega_m was stated with that factor and that share as its deviation.
RungConstant found_Jxx(double factor, double std_of_lag) {
  const Vehicle truth = quad(0.0);
  Vehicle stated = testing::known(truth);
  Known& omega_m = stated.parameters["omega_m"];
  omega_m.value *= factor, omega_m.std = std_of_lag * omega_m.value;
  FlightLog log = flight(truth, 100, 3);
  log.Omega.clear();
  const Flown flown(std::move(stated), std::move(log));
  const auto ladder = climb_ladder(flown.record);
  const RungResult& inertia = rung_of(ladder.value(), Rung::inertia);
  return *std::ranges::find(inertia.constants, "Jxx", &RungConstant::name);
}

TEST(Ladder, InertiaBearsWhatIsNotKnownOfTheMotors) {
  const double share = 0.1;
  const RungConstant right = found_Jxx(1.0, 1e-6), off = found_Jxx(1 + share, 1e-6),
                     open = found_Jxx(1.0, share);
  const double moved = std::abs(off.value - right.value);  // by one deviation of the lag
  ASSERT_GT(moved, 0.7 * right.std);                       // or this test could not fail
  EXPECT_NEAR(open.std, std::hypot(right.std, moved), 0.1 * open.std);
}

// Speeds of another flight: whatever moves the vehicle, it is not these.
TEST(Ladder, SaysSoWhereRotorsDoNotExplainHowTheVehicleTurned) {
  const Vehicle truth = in_air();
  FlightLog log = flight(truth, 100, 3);
  const FlightLog other = flight(truth, 100, 8);
  for (std::size_t n = 0; n < log.Omega.size(); ++n)
    std::copy_n(other.Omega[n].begin(), std::min(log.rows(), other.rows()), log.Omega[n].begin());
  const Flown flown(as_stated(truth), log);
  const auto ladder = climb_ladder(flown.record);
  ASSERT_TRUE(ladder);
  EXPECT_TRUE(ladder->moments_unexplained);
}

TEST(Ladder, FlightTooShortToHoldAnythingOutGivesNone) {
  const Vehicle truth = in_air();
  const Flown flown(as_stated(truth), flight(truth, 100, 3, 3.0));
  EXPECT_FALSE(climb_ladder(flown.record));
}

}  // namespace
}  // namespace ident
