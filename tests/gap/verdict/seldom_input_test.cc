// A diagnosis of logs whose commands leave out most of what was flown.
#include "ident/gap/verdict/seldom_input.h"

#include <gtest/gtest.h>

#include "ident/gap/diagnose.h"
#include "support/known_quad.h"

namespace ident {
namespace {

TEST(SeldomInput, LeavesOnlyNoneAsItIs) {
  const Judged none = with_seldom_commands({.status = "none", .sentence = "No cause stands out."}, 0.1);
  EXPECT_EQ(none.status, "none");
  EXPECT_EQ(none.sentence, "No cause stands out.");

  Judged named{.status = "identified", .effects = {"battery_sag"}, .confused_with = {"wind"}};
  named = with_seldom_commands(std::move(named), 0.1);
  EXPECT_EQ(named.status, "unknown");
  EXPECT_TRUE(named.effects.empty());
  EXPECT_EQ(named.confused_with, (std::vector<std::string>{"battery_sag", "wind"}));
  EXPECT_NE(named.sentence.find("come at 10 Hz"), std::string::npos) << named.sentence;
  EXPECT_NE(named.sentence.find("nearest cause is battery_sag"), std::string::npos) << named.sentence;
}

TEST(SeldomInput, IsWhyNothingIsNamed) {
  SimulationOptions options;
  options.duration = 20, options.by_gyro = true, options.signals.rotor_speeds = 0;
  FlightLog log = simulate_flight(testing::quad(), options).log;
  for (auto& column : log.delta)
    for (std::size_t i = 0; i < log.rows(); ++i) column[i] = column[i - i % 25];
  const Result result = diagnose_gap(testing::known(testing::quad()), std::vector{log}).result;
  EXPECT_EQ(result.extra["verdict"]["status"], "unknown");
  EXPECT_EQ(result.extra["verdict"]["effects"].size(), 0u);
  EXPECT_NE(result.verdict.find("their commands come at 10 Hz"), std::string::npos) << result.verdict;
}

}  // namespace
}  // namespace ident
