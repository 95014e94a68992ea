// Tones of rotors are taken out of rates and specific force, by rotor, and nothing else is.
#include "ident/flight/conditioning/rotor_vibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "ident/core/random.h"
#include "ident/flight/checks/vibration_in_commands.h"
#include "ident/flight/make_record.h"
#include "support/shaken.h"

namespace ident {
namespace {

using testing::flown;
using testing::shaken;

struct Freed {
  Vibration vibration;
  std::vector<FlightLog> logs;
  std::vector<Warning> warnings;
};

Freed freed(const Vehicle& model, const FlightLog& log) {
  const std::vector<double> p = parameter_vector(model);
  const std::span<const FlightLog> logs(&log, 1);
  Freed out;
  out.logs = without_vibration(make_flight_record(model, p, logs), logs, out.vibration, out.warnings);
  return out;
}

// RMS of the difference of two columns.
double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(a[i] - b[i], 2);
  return std::sqrt(square / static_cast<double>(a.size()));
}

TEST(Vibration, AQuietFlightIsLeftAlone) {
  for (const bool speeds : {true, false}) {
    const FlightLog log = flown(testing::shaken_vehicle(), 1, speeds);
    const Freed out = freed(testing::shaken_vehicle(), log);
    EXPECT_TRUE(out.logs.empty()) << speeds;
    EXPECT_FALSE(out.vibration.found());
    EXPECT_TRUE(out.warnings.empty());
    EXPECT_EQ(out.vibration.stands_out(), 0);
  }
}

TEST(Vibration, OfAllRotorsIsTakenOutAndNoneStandsOut) {
  const Vehicle vehicle = testing::shaken_vehicle();
  const FlightLog quiet = flown(vehicle, 2, true), loud = shaken(quiet, {1.0, 1.5, 0.8, 1.2});
  const Freed out = freed(vehicle, loud);
  ASSERT_EQ(out.logs.size(), 1u);
  ASSERT_EQ(out.warnings.size(), 1u);
  EXPECT_EQ(out.warnings[0].code, "vibration");
  EXPECT_EQ(out.vibration.stands_out(), 0) << out.vibration.what_is_unbalanced();
  EXPECT_DOUBLE_EQ(out.vibration.speeds, 1.0);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(apart(out.logs[0].f_B[c], quiet.f_B[c]), 0.45 * apart(loud.f_B[c], quiet.f_B[c])) << c;
    EXPECT_LT(apart(out.logs[0].w_B[c], quiet.w_B[c]), 0.45 * apart(loud.w_B[c], quiet.w_B[c])) << c;
  }
  // Each axis and rotor has its share: an RMS over axes by all rotors.
  double force = 0;
  for (std::size_t c = 0; c < 3; ++c) force += std::pow(apart(loud.f_B[c], quiet.f_B[c]), 2) / 3;
  EXPECT_NEAR(out.vibration.force, std::sqrt(force), 0.15 * std::sqrt(force));
  // In the order in which they were shaken.
  const std::vector<double>& of = out.vibration.of_rotor;
  EXPECT_GT(of[1], of[0]);
  EXPECT_LT(of[2], of[3]);
}

TEST(Vibration, OneRotorOutOfBalanceIsNamed) {
  const Vehicle vehicle = testing::shaken_vehicle();
  const FlightLog quiet = flown(vehicle, 3, true);
  const Freed alone = freed(vehicle, shaken(quiet, {0, 0, 0.8, 0}));
  EXPECT_EQ(alone.vibration.stands_out(), 3);
  EXPECT_NE(alone.vibration.what_is_unbalanced().find("rotor 3"), std::string::npos);
  const Freed among = freed(vehicle, shaken(quiet, {0.5, 3.0, 0.4, 0.6}));
  EXPECT_EQ(among.vibration.stands_out(), 2);
  EXPECT_FALSE(among.vibration.one_alone);
  EXPECT_NE(among.vibration.what_is_unbalanced().find("rotor 2"), std::string::npos);
}

// Where motion is too, little of a tone counts, and little of what is there: that bounds no size.
TEST(Vibration, ALargeSlowPropellerOutOfBalanceIsNamedDespiteMotion) {
  Vehicle vehicle = testing::shaken_vehicle();
  for (const auto& [name, share] : std::initializer_list<std::pair<const char*, double>>{
           {"km", 1.0 / 3}, {"kT", 9.0}, {"kQ", 9.0}, {"omega_m", 0.6}})
    vehicle.parameters.at(name).value *= share;
  FlightLog log = flown(vehicle, 3, true);
  const std::vector<std::vector<double>> Omega = log.Omega;
  testing::shake(log, Omega, 150.0, {0, 0, 0, 8.0}, 0.02);
  const Freed out = freed(vehicle, log);
  EXPECT_EQ(out.vibration.stands_out(), 4) << ::testing::PrintToString(out.vibration.of_rotor);
}

TEST(Vibration, RotorsOfEqualSpeedAreNotSeparated) {
  const Vehicle vehicle = testing::shaken_vehicle();
  FlightLog log = flown(vehicle, 3, true);
  for (std::vector<double>& speed : log.Omega) speed = log.Omega[0];
  const Freed out = freed(vehicle, shaken(log, {0.8, 0, 0, 0}));
  EXPECT_TRUE(out.vibration.unbalanced());
  EXPECT_EQ(out.vibration.stands_out(), 0);
  EXPECT_NE(out.vibration.what_is_unbalanced().find("do not tell"), std::string::npos)
      << out.vibration.what_is_unbalanced();
}

TEST(Vibration, CommandsWithAWrongGainAreCorrectedByTheTonesThemselves) {
  const Vehicle vehicle = testing::shaken_vehicle();
  Vehicle model = vehicle;
  model.parameters.at("km").value *= 1.04;
  const FlightLog log = shaken(flown(vehicle, 4, true), {1.0, 1.5, 0.8, 1.2});
  FlightLog without = log;
  without.Omega.clear();
  const Freed out = freed(model, without);
  ASSERT_TRUE(out.vibration.found());
  EXPECT_NEAR(out.vibration.speeds, 1 / 1.04, 0.002);
  EXPECT_EQ(out.vibration.stands_out(), 0);
}

// A blade that passes twice a turn is no slower motion and no other line: what is not of the rotors stays.
TEST(Vibration, ALineThatIsNotOfTheRotorsStays) {
  FlightLog log = flown(testing::shaken_vehicle(), 5, true);
  const FlightLog quiet = log;
  for (std::size_t i = 0; i < log.rows(); ++i) log.f_B[1][i] += 0.3 * std::sin(2 * M_PI * 41.0 * log.t[i]);
  const Freed out = freed(testing::shaken_vehicle(), log);
  if (!out.logs.empty()) {
    EXPECT_GT(apart(out.logs[0].f_B[1], quiet.f_B[1]), 0.9 * apart(log.f_B[1], quiet.f_B[1]));
  }
}

// Its spectrum is as uneven as that of a shaken sensor.
TEST(Vibration, NoiseThatWasFilteredIsNoTone) {
  for (const double turns : {1.0, 0.9, 0.82, 0.6}) {  // as fast as usual
    FlightLog log = flown(testing::shaken_vehicle(), 9, true);
    for (std::vector<double>& speed : log.Omega)
      for (double& Omega : speed) Omega *= turns;
    Random random(9);
    for (auto* sensor : {&log.w_B, &log.f_B})
      for (std::vector<double>& column : *sensor) {
        double noise = 0;
        for (double& y : column) {
          noise = 0.6 * noise + 0.4 * random.normal();
          y += (sensor == &log.w_B ? 0.02 : 0.4) * noise;
        }
      }
    const Freed out = freed(testing::shaken_vehicle(), log);
    EXPECT_TRUE(out.logs.empty()) << turns;
  }
}

// Eighty-five samples a second of some seventy-six turns: motion at times, tones at others.
TEST(Vibration, SamplesWhoseTonesAliasOntoMotionAreDropped) {
  const Vehicle vehicle = testing::shaken_vehicle();
  const FlightLog quiet = flown(vehicle, 8, true, 85.0), loud = shaken(quiet, {1.0, 1.5, 0.8, 1.2});
  const Freed out = freed(vehicle, loud);
  ASSERT_EQ(out.logs.size(), 1u);
  EXPECT_NE(out.warnings[0].message.find("passes for motion"), std::string::npos) << out.warnings[0].message;
  double lost = 0, square = 0, before = 0;
  for (std::size_t i = 0; i < loud.rows(); ++i) {
    const double left = out.logs[0].f_B[0][i] - quiet.f_B[0][i];
    ASSERT_EQ(std::isnan(left), std::isnan(out.logs[0].f_B[2][i]));  // all axes of a sensor or none
    if (std::isnan(left))
      lost += 1;
    else
      square += left * left, before += std::pow(loud.f_B[0][i] - quiet.f_B[0][i], 2);
  }
  const auto rows = static_cast<double>(loud.rows());
  EXPECT_GT(lost, 0.01 * rows);
  EXPECT_LT(lost, 0.8 * rows);
  EXPECT_LT(square, 0.5 * before);
}

// A controller that oscillates in yaw as fast as a rotor's turns show.
TEST(Vibration, CommandedMotionIsNoTone) {
  Vehicle vehicle = testing::shaken_vehicle();
  vehicle.parameters.at("Jp").value *= 25;
  const FlightLog quiet = flown(vehicle, 8, true);
  FlightLog told = quiet;
  constexpr double kSize = 0.5, kHz = 75.0;  // of the command
  const std::complex<double> s(0, 2 * M_PI * kHz);
  const double omega_m = vehicle.value("omega_m"), zeta_m = vehicle.value("zeta_m");
  const std::complex<double> Omega = vehicle.value("km") * kSize * omega_m * omega_m /
                                     (s * s + 2 * zeta_m * omega_m * s + omega_m * omega_m);
  const double yaw = 4 * std::abs(Omega) * vehicle.value("Jp") / vehicle.value("Jzz");
  double angle = 0;
  for (std::size_t i = 0; i < told.rows(); ++i) {
    if (i > 0) angle += 0.5 * (quiet.Omega[0][i] + quiet.Omega[0][i - 1]) * (told.t[i] - told.t[i - 1]);
    for (std::size_t n = 0; n < 4; ++n) told.delta[n][i] += vehicle.rotors[n].s * kSize * std::sin(angle);
    told.w_B[2][i] += yaw * std::sin(angle + 1.0);
  }
  FlightLog shaken_only = told, passed_on = told;
  shaken_only.delta = quiet.delta;
  for (std::size_t i = 0; i < told.rows(); ++i)  // an eighth of it comes back from the motors
    passed_on.w_B[2][i] += 7 * (told.w_B[2][i] - quiet.w_B[2][i]);
  for (FlightLog* log : {&told, &shaken_only, &passed_on}) log->Omega.clear();
  EXPECT_FALSE(freed(vehicle, told).vibration.found());
  const Vibration felt = freed(vehicle, shaken_only).vibration,
                  answered = freed(vehicle, passed_on).vibration;
  EXPECT_TRUE(felt.found());
  EXPECT_FALSE(felt.passed_on);
  EXPECT_TRUE(answered.found());
  EXPECT_TRUE(answered.passed_on);
  Result result;
  for (const char* name : {"omega_m", "Jxx"}) {
    Parameter p;
    p.name = name, p.identifiable = true;
    result.parameters.push_back(p);
  }
  doubt_passed_on(result, felt);
  EXPECT_TRUE(result.find("omega_m")->identifiable);
  doubt_passed_on(result, answered);
  EXPECT_FALSE(result.find("omega_m")->identifiable);
  EXPECT_TRUE(result.find("Jxx")->identifiable);
}

// Where power grows to the end of what simulated speeds may be off by, something else lies beyond.
TEST(Vibration, ATwelfthFasterThanSimulatedRotorsCanTurnIsNoTone) {
  const Vehicle vehicle = testing::shaken_vehicle();
  for (const double faster : {1.06, 1.12}) {
    const FlightLog quiet = flown(vehicle, 4, true);
    FlightLog loud = quiet;
    std::vector<std::vector<double>> Omega = quiet.Omega;
    for (std::vector<double>& speed : Omega)
      for (double& v : speed) v *= faster;
    testing::shake(loud, Omega, 450.0, {1.0, 1.5, 0.8, 1.2}, 0.05);
    loud.Omega.clear();
    EXPECT_EQ(freed(vehicle, loud).vibration.found(), faster < 1.1) << faster;
  }
}

TEST(Vibration, LogsWithGapsAndMixedRatesAreTakenAsTheyAre) {
  const Vehicle vehicle = testing::shaken_vehicle();
  const FlightLog quiet = flown(vehicle, 6, true);
  FlightLog loud = shaken(quiet, {1.0, 1.5, 0.8, 1.2});
  for (std::size_t i = 0; i < loud.rows(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      if (i % 2 == 1) loud.f_B[c][i] = kNaN;  // half as often
      if (i > 3000 && i < 3100) loud.w_B[c][i] = kNaN;
    }
  const Freed out = freed(vehicle, loud);
  ASSERT_EQ(out.logs.size(), 1u);
  for (std::size_t i = 0; i < loud.rows(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_EQ(std::isfinite(out.logs[0].f_B[c][i]), std::isfinite(loud.f_B[c][i])) << i;
      ASSERT_EQ(std::isfinite(out.logs[0].w_B[c][i]), std::isfinite(loud.w_B[c][i])) << i;
    }
  EXPECT_EQ(out.vibration.stands_out(), 0);
  for (const auto sensor : {&FlightLog::w_B, &FlightLog::f_B}) {  // both get quieter
    double left = 0, before = 0;
    for (std::size_t i = 0; i < loud.rows(); ++i)
      if (const double y = (out.logs[0].*sensor)[0][i]; std::isfinite(y))
        left += std::pow(y - (quiet.*sensor)[0][i], 2),
            before += std::pow((loud.*sensor)[0][i] - (quiet.*sensor)[0][i], 2);
    EXPECT_LT(left, 0.3 * before);
  }
}

// Two axes of a planar rig, and one that shows nothing.
TEST(Vibration, AConstantOrMissingAxisSpoilsNoOther) {
  const Vehicle vehicle = testing::shaken_vehicle();
  for (const double value : {0.0, 0.7, kNaN}) {
    FlightLog loud = shaken(flown(vehicle, 10, true), {1.0, 1.5, 0.8, 1.2});
    for (double& r : loud.w_B[2]) r = value;
    const Freed out = freed(vehicle, loud);
    ASSERT_EQ(out.logs.size(), 1u) << value;
    for (const double x : out.vibration.of_rotor) EXPECT_TRUE(std::isfinite(x)) << value;
    for (std::size_t i = 0; i < loud.rows(); ++i)
      ASSERT_EQ(std::isnan(out.logs[0].w_B[2][i]), std::isnan(value)) << i;
  }
}

}  // namespace
}  // namespace ident
