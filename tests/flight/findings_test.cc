// Logs that are not what they seem: rows far apart, holes, clocks set back, two vehicles, hover alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/core/error.h"
#include "ident/core/statistics.h"
#include "ident/flight/checks/commands_vs_speeds.h"
#include "ident/flight/conditioning/battery_voltage.h"
#include "ident/flight/make_record.h"
#include "ident/flight/record/flight_record.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using testing::flight;
using testing::hover;
using testing::known;
using testing::quad;

double off(const Result& result, const std::string& name, const Vehicle& truth) {
  const Parameter* p = result.find(name);
  return (p->value - truth.value(name)) / p->std;
}

// A command that changes within a step is a line there: over 10 ms that once put the dead time ten deviations
// off.
TEST(FlightFindings, MotorsAreFoundFromRowsThatAreFarApart) {
  const Vehicle truth = quad();
  for (const double rate : {50.0, 100.0}) {
    const FlightLog log = flight(truth, rate, 3);
    const Result result = refine_flight(known(truth), std::span(&log, 1), {.validate = false});
    for (const char* name : {"omega_m", "zeta_m", "dead_time"})
      EXPECT_LT(std::abs(off(result, name, truth)), 3.5) << name << " at " << rate << " Hz";
  }
}

TEST(FlightFindings, LogsOfTwoVehiclesAreReportedAsInconsistent) {
  const Vehicle truth = quad();
  Vehicle other = truth;
  for (const char* name : {"Jxx", "Jyy", "Jzz"}) other.parameters[name].value *= 1.8;
  other.parameters["omega_m"].value = 40, other.parameters["kT"].value = 9e-7;
  std::vector<FlightLog> logs{flight(truth, 250, 1, 25), flight(other, 250, 2, 25)};
  logs[0].file = "own.csv", logs[1].file = "other.csv";
  const Result result = refine_flight(known(truth), logs, {.validate = false});
  ASSERT_TRUE(result.has_warning("logs_disagree"));
  const auto w = std::ranges::find(result.warnings, "logs_disagree", &Warning::code);
  EXPECT_TRUE(w->message.starts_with("other.csv")) << w->message;
  for (const Parameter& p : result.parameters) EXPECT_FALSE(p.identifiable) << p.name;
  logs[1] = flight(truth, 250, 2, 25);
  EXPECT_FALSE(refine_flight(known(truth), logs, {.validate = false}).has_warning("logs_disagree"));
}

// With the rows of a hole the commands in it are missing.
TEST(FlightFindings, AHoleOfATenthOfASecondEndsAnArc) {
  const Vehicle v = quad();
  FlightLog log = flight(v, 250, 1, 10);
  const auto arcs = [&] {
    return make_flight_record(v, parameter_vector(v), std::span(&log, 1)).arcs.size();
  };
  EXPECT_EQ(arcs(), 1u);
  for (std::size_t i = 1000; i < log.t.size(); ++i) log.t[i] += 0.1;
  EXPECT_EQ(arcs(), 2u);
}

TEST(FlightFindings, AClockSetBackEndsAnArc) {
  const Vehicle v = quad();
  FlightLog log = flight(v, 250, 1, 10);
  log.breaks = {log.t[1000]};
  EXPECT_EQ(make_flight_record(v, parameter_vector(v), std::span(&log, 1)).arcs.size(), 2u);
}

// Free, the lag once came out at half its value with a deviation of 3 %, from noise alone.
TEST(FlightFindings, HoverAloneLeavesMotorsAndInertiaAsTheyWere) {
  const Vehicle truth = quad();
  const FlightLog log = hover(truth, 30);
  const Result result = refine_flight(known(truth), std::span(&log, 1), {.validate = false});
  ASSERT_TRUE(result.has_warning("hover_only"));
  for (const char* name : {"omega_m", "zeta_m", "Jxx", "Jzz", "Jp", "kQ"}) {
    const Parameter* p = result.find(name);
    EXPECT_FALSE(p->identifiable) << name;
    EXPECT_DOUBLE_EQ(p->value, truth.value(name)) << name;
    EXPECT_NEAR(p->std, 0.08 * p->value, 1e-9 * p->value) << name;
  }
}

// A state that nothing measures once took all digits of the others with it, and what kept it in place passed
// for information: km was known to a ten-thousandth, wrongly.
TEST(FlightFindings, MissingSensorsNeverNarrowAnInterval) {
  const Vehicle truth = quad();
  Vehicle stated = known(truth);
  stated.parameters["km"].value *= 1.02;
  FlightLog whole = flight(truth, 100, 3, 25);
  whole.Omega.clear();
  const Result full = refine_flight(stated, std::span(&whole, 1), {.validate = false});
  FlightLog no_height = whole, no_path = whole, rates_and_force = whole;
  no_height.x_W[2].clear(), no_height.v_W[2].clear();
  no_path.x_W = {};
  rates_and_force.x_W = rates_and_force.v_W = {}, rates_and_force.q_WB = {};
  for (const std::vector<FlightLog>& logs :
       {std::vector{no_height}, std::vector{whole, no_path}, std::vector{whole, rates_and_force}}) {
    const Result less = refine_flight(stated, logs, {.validate = false});
    const double more_data = logs.size() > 1 ? std::sqrt(2.0) : 1.0;
    for (const char* name : {"kT", "km", "omega_m", "Jxx"}) {
      EXPECT_GT(less.find(name)->std * more_data, 0.9 * full.find(name)->std) << name;
      EXPECT_LT(less.find(name)->std, 1.6 * full.find(name)->std) << name;
      EXPECT_LT(std::abs(off(less, name, truth)), 4.0) << name;
    }
  }
}

// Telemetry puts the messages of several sensors into rows of their own, a thousandth of a second apart.
TEST(FlightFindings, MessagesInRowsOfTheirOwnAreNoHoles) {
  const Vehicle truth = quad();
  FlightLog log = flight(truth, 20, 2, 30);
  FlightLog apart = log;
  const auto spread = [](std::vector<double>& column, std::size_t message) {
    std::vector<double> rows;
    for (const double y : column)
      for (std::size_t k = 0; k < 4; ++k) rows.push_back(k == message ? y : std::nan(""));
    column = std::move(rows);
  };
  std::vector<double> t;
  for (const double at : log.t)
    for (int k = 0; k < 4; ++k) t.push_back(at + 1e-3 * k);
  apart.t = t, apart.Omega.clear(), log.Omega.clear();
  for (auto& c : apart.delta) spread(c, 0);
  for (std::size_t k = 0; k < 3; ++k)
    spread(apart.w_B[k], 1), spread(apart.f_B[k], 1), spread(apart.v_W[k], 3), spread(apart.x_W[k], 3);
  for (auto& c : apart.q_WB) spread(c, 2);
  const auto seconds = [&](const FlightLog& one) {
    return make_flight_record(truth, parameter_vector(truth), std::span(&one, 1)).duration;
  };
  EXPECT_GT(seconds(apart), 0.95 * seconds(log));
}

// Small holes everywhere: what is left between them is too short for anything, so they are bridged, and told.
TEST(FlightFindings, HolesThatWouldLeaveNothingAreBridged) {
  const Vehicle v = quad();
  const FlightLog whole = flight(v, 250, 1, 10);
  FlightLog log = whole;
  const auto thin = [&](std::vector<double>& column) {
    std::vector<double> rest;
    for (std::size_t i = 0; i < column.size(); ++i)
      if (i % 75 >= 8) rest.push_back(column[i]);
    column = std::move(rest);
  };
  thin(log.t);
  for (auto* columns : {&log.delta, &log.Omega})
    for (auto& c : *columns) thin(c);
  for (auto* columns : {&log.w_B, &log.f_B, &log.v_W, &log.x_W})
    for (auto& c : *columns) thin(c);
  for (auto& c : log.q_WB) thin(c);
  const FlightRecord record = make_flight_record(v, parameter_vector(v), std::span(&log, 1));
  EXPECT_GT(record.duration, 9.0);
  EXPECT_NE(std::ranges::find(record.warnings, "holes_bridged", &Warning::code), record.warnings.end());
}

// A log of a few rows beside a whole one is not full of holes: it holds no flight.
TEST(FlightFindings, ALogWithoutALongEnoughArcIsReported) {
  const Vehicle vehicle = quad();
  std::vector<FlightLog> logs(2, flight(vehicle, 250, 1, 5));
  logs[1].file = "cut.csv";
  logs[1].windows = {{0.0, 0.05}};
  const FlightRecord record = make_flight_record(vehicle, parameter_vector(vehicle), logs);
  ASSERT_EQ(record.warnings.size(), 1u);
  EXPECT_EQ(record.warnings[0].code, "log_not_used");
  EXPECT_TRUE(record.warnings[0].message.starts_with("cut.csv: ")) << record.warnings[0].message;
}

// What the model lacks makes a log with other manoeuvres ask for other constants; thrust it leaves alone.
TEST(FlightFindings, AMissingEffectIsNoOtherVehicle) {
  Vehicle truth = quad();
  truth.parameters["axial_inflow.kz"] = {1.5e-4, {}}, truth.parameters["rotor_drag.kd"] = {1e-4, {}};
  SimulationOptions gentle;
  gentle.scenario = "eight", gentle.duration = 25, gentle.seed = 2;
  const std::vector<FlightLog> logs{flight(truth, 250, 1, 25), simulate_flight(truth, gentle).log};
  EXPECT_FALSE(refine_flight(known(quad()), logs, {.validate = false}).has_warning("logs_disagree"));
}

// Commands that were left out of one log serve for none.
TEST(FlightFindings, SpeedsAreTheInputOfAllLogsWhenOneHasNoCommands) {
  const Vehicle truth = quad();
  std::vector<FlightLog> logs{flight(truth, 100, 1, 20), flight(truth, 100, 2, 20)};
  logs[1].delta.clear();
  const Result result = refine_flight(known(truth), logs, {.validate = false});
  EXPECT_TRUE(result.has_warning("commands_left_out"));
  EXPECT_EQ(result.find("omega_m"), nullptr);
  EXPECT_LT(std::abs(off(result, "Jxx", truth)), 4.0);
}

// Commands that stand at one limit or the other: no lag makes speeds of these. What the speeds tell stays.
TEST(FlightFindings, SpeedsAreTheInputWhereTheyContradictTheCommands) {
  const Vehicle truth = quad();
  FlightLog log = flight(truth, 100, 1, 20);
  EXPECT_FALSE(commands_contradict_speeds(log));
  FlightLog swapped = log;
  std::swap(swapped.delta[0], swapped.delta[2]);
  std::swap(swapped.delta[1], swapped.delta[3]);
  EXPECT_FALSE(commands_contradict_speeds(swapped));  // that is a wrong order
  const double hover = median(log.delta[0]);
  for (auto& column : log.delta)
    for (double& delta : column) delta = delta > hover ? 1.0 : 0.0;
  ASSERT_TRUE(commands_contradict_speeds(log));
  const Result result = refine_flight(known(truth), std::span(&log, 1), {.validate = false});
  EXPECT_TRUE(result.has_warning("commands_contradict_speeds"));
  EXPECT_EQ(result.find("omega_m"), nullptr);
  EXPECT_LT(std::abs(off(result, "kT", truth)), 4.0);
  EXPECT_LT(std::abs(off(result, "Jxx", truth)), 4.0);
  std::vector<FlightLog> logs{log, flight(truth, 100, 2, 20)};
  logs[1].Omega.clear();
  EXPECT_THROW(refine_flight(known(truth), logs, {.validate = false}), DataError);
}

TEST(FlightFindings, TheSignOfACommandIsNone) {
  for (const char* scenario : {"steps", "mixed"}) {
    SimulationOptions options;
    options.scenario = scenario, options.rate = 100, options.duration = 30;
    FlightLog log = simulate_flight(quad(), options).log;
    EXPECT_FALSE(commands_contradict_speeds(log)) << scenario;
    FlightLog turned = log;
    for (auto& column : turned.delta)
      for (double& delta : column) delta = 1 - delta;
    EXPECT_TRUE(commands_contradict_speeds(turned)) << scenario;
    for (auto& column : log.delta) {
      const double middle = median(column);
      for (double& delta : column) delta = delta > middle ? 1.0 : 0.0;
    }
    EXPECT_TRUE(commands_contradict_speeds(log)) << scenario;
  }
}

// Slow or fast, hardly damped or hardly moving: motors are no reason to distrust commands.
TEST(FlightFindings, CommandsAreConsistentWithAnyMotorLag) {
  for (const auto& [omega_m, zeta_m] : {std::pair{5.0, 0.4}, {5.0, 2.0}, {80.0, 0.4}, {80.0, 2.0}}) {
    Vehicle vehicle = quad();
    vehicle.parameters["omega_m"].value = omega_m, vehicle.parameters["zeta_m"].value = zeta_m;
    for (const char* scenario : {"steps", "mixed", "eight"}) {
      SimulationOptions options;
      options.scenario = scenario, options.rate = 250, options.duration = 30;
      EXPECT_FALSE(commands_contradict_speeds(simulate_flight(vehicle, options).log))
          << scenario << ", " << omega_m << ", " << zeta_m;
    }
  }
}

// A controller makes up for a battery that falls: commands rise, speeds and flight stay.
TEST(FlightFindings, BatterySagDoesNotContradictCommands) {
  for (const char* scenario : {"eight", "mixed", "hover"}) {
    SimulationOptions options;
    options.scenario = scenario, options.rate = 100, options.duration = 60;
    FlightLog log = simulate_flight(quad(), options).log;
    for (auto& column : log.delta)
      for (std::size_t i = 0; i < column.size(); ++i) column[i] /= 1 - 0.2 * log.t[i] / log.t.back();
    EXPECT_FALSE(commands_contradict_speeds(log)) << scenario;
  }
}

// Speeds that do nothing but shake say nothing of commands.
TEST(FlightFindings, NearlyConstantSpeedsDoNotContradictCommands) {
  const Vehicle truth = quad();
  FlightLog log = hover(truth, 20);
  Random random(3);
  log.Omega.assign(4, std::vector<double>(log.t.size()));
  for (auto& column : log.Omega)
    for (double& Omega : column) Omega = 940 + 10 * random.normal();
  EXPECT_FALSE(commands_contradict_speeds(log));
  for (auto& column : log.Omega)  // telemetry at a fifth of the rate, held
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = column[i - i % 5];
  EXPECT_FALSE(commands_contradict_speeds(log));
}

TEST(FlightFindings, AnUnmodelledBatteryIsReported) {
  Vehicle vehicle = quad();
  FlightLog log = flight(vehicle, 100, 1, 10.0);
  const auto falls_by = [&](double share) {
    log.vbat.assign(log.t.size(), 16.0);
    for (std::size_t i = 0; i < log.vbat.size(); ++i)
      log.vbat[i] *= 1 - share * static_cast<double>(i) / static_cast<double>(log.vbat.size());
    log.vbat[5] = 3.0;  // a spike
    return battery_not_modelled(vehicle, std::span(&log, 1));
  };
  EXPECT_FALSE(falls_by(0.01));
  ASSERT_TRUE(falls_by(0.05));
  EXPECT_EQ(falls_by(0.05)->code, "battery_not_modelled");
  vehicle.parameters["battery_sag.n"] = {1.0, 0.3};
  EXPECT_FALSE(falls_by(0.05));
  vehicle.parameters.erase("battery_sag.n");
  log.delta.clear();
  EXPECT_FALSE(falls_by(0.05));
}

}  // namespace
}  // namespace ident
