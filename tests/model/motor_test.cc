// The motor between rows: commands that change within a step.
#include "ident/model/motor.h"

#include <gtest/gtest.h>

#include "ident/core/dual.h"
#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"

namespace ident {
namespace {

struct Here {
  static constexpr int kBytes = 16;
};

constexpr double kDelay = 0.0013;

/// Speed of a rotor after 0.1 s of a staircase at 250 Hz that arrives `kDelay` late.
double speed_after(double step) {
  Vehicle v;
  v.rotors = layout_rotors("plus", 0.2, 0.0);
  v.parameters = {{"m", {0.5, {}}},      {"kT", {6e-6, {}}},         {"kQ", {1e-7, {}}},  {"km", {900, {}}},
                  {"omega_m", {60, {}}}, {"zeta_m", {0.7, {}}},      {"Jxx", {3e-3, {}}}, {"Jyy", {3e-3, {}}},
                  {"Jzz", {5e-3, {}}},   {"dead_time", {kDelay, {}}}};
  FlightInputs in;
  std::vector<double> t, delta;
  for (int i = 0; i <= 25; ++i) t.push_back(0.004 * i), delta.push_back(0.5 + 0.2 * std::sin(1.7 * i));
  in.delta.assign(4, HeldCommand(t, delta));
  const std::vector<double> p = parameter_vector(v);
  const EffectSet<double> none(p, 0);
  Flight<double, EffectSet<double>> flight(v, p, none, in);
  std::array<MotorState<double>, kMaxRotors> motors{};
  const int steps = static_cast<int>(std::lround(0.1 / step));
  for (int i = 0; i < steps; ++i) flight.advance(motors, i * step, step);
  return motors[0].Omega;
}

// 0.1 ms: every change of the command falls between two steps.
TEST(Motor, AStepFromRowToRowPutsDelayedCommandsWhereTheyBelong) {
  const double exact = speed_after(1e-4);
  EXPECT_NEAR(speed_after(2e-3) / exact, 1.0, 1e-5);
  EXPECT_NEAR(speed_after(4e-3) / exact, 1.0, 5e-5);
}

TEST(HeldCommand, TheLineHasTheMeanAndTheFirstMomentOfTheCommand) {
  const HeldCommand command({0.0, 1.0, 2.0}, {0.0, 3.0, 1.0});
  // From 0.5 to 2.5, no delay: 0 for 0.5, 3 for 1, 1 for 0.5: mean 3.5/2. First moment about the middle:
  // 0 + 3 (0) + 1 (0.75)(0.5) = 0.375 = slope h^3/12.
  const auto line = command.line<double>(0.5, 2.5, 0.0);
  EXPECT_DOUBLE_EQ(line.mean, 1.75);
  EXPECT_NEAR(line.slope, 0.375 * 12 / 8, 1e-14);
  EXPECT_FALSE(command.line<double>(0.2, 0.8, 0.0).bent);
  EXPECT_DOUBLE_EQ(command.line<double>(-3.0, -2.0, 0.0).mean, 0.0);
  EXPECT_NEAR(command.line<double>(1.7, 2.7, 0.5).mean, 0.8 * 3.0 + 0.2 * 1.0, 1e-14);
}

// Commands are sampled where steps begin. There a delay of zero has the derivative of a small one, over many
// rows whose times are rounded.
TEST(HeldCommand, AnyDelayMovesAJumpOnTheEdgeIntoTheLaterStep) {
  using D = Dual<1, Here>;
  std::vector<double> t, delta;
  for (int i = 0; i < 400; ++i)
    t.push_back(700.0 + 0.004 * i), delta.push_back(0.5 + 0.1 * std::sin(1.7 * i));
  const HeldCommand command(t, delta);
  for (std::size_t i = 1; i + 1 < t.size(); ++i) {
    const double h = (t[i + 1] - t[i]) / 2, tiny = 1e-7;
    for (const double from : {t[i], t[i] + h}) {
      D none(0.0);
      none.seed(0);
      const auto exact = command.line<D>(from, from + h, none);
      const auto later = command.line<double>(from, from + h, tiny);
      const auto now = command.line<double>(from, from + h, 0.0);
      ASSERT_NEAR(exact.mean.v, delta[i], 1e-12) << i;
      ASSERT_NEAR(exact.mean.derivative(0), (later.mean - now.mean) / tiny,
                  1e-6 + 1e-3 * std::abs(exact.mean.derivative(0)))
          << i;
    }
  }
}

}  // namespace
}  // namespace ident
