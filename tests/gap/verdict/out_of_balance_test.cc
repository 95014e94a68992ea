// What all rotors shake is no gap; a propeller out of balance is one that nothing in the catalogue explains.
#include "ident/gap/verdict/out_of_balance.h"

#include <gtest/gtest.h>

#include "support/diagnosed.h"
#include "support/shaken.h"

namespace ident {
namespace {

using testing::flown;
using testing::shaken;
using testing::verdict_of;

Vibration one_of_four() {
  return {.of_rotor = {0.1, 0.1, 0.9, 0.1}, .rates = 0.01, .force = 0.2, .told_apart = true};
}

TEST(WithVibration, NothingStandsOutNothingChanges) {
  const Judged named = with_vibration({.status = "identified", .sentence = "x", .effects = {"cg_offset"}},
                                      {.of_rotor = {0.5, 0.6, 0.4, 0.5}});
  EXPECT_EQ(named.status, "identified");
  EXPECT_EQ(named.sentence, "x");
  EXPECT_EQ(with_vibration({.status = "none"}, {}).status, "none");
}

TEST(WithVibration, AnUnbalancedPropellerIsUnknownAndSaysWhich) {
  const Judged none = with_vibration({.status = "none", .sentence = "No cause stands out."}, one_of_four());
  EXPECT_EQ(none.status, "unknown");
  EXPECT_NE(none.sentence.find("rotor 3"), std::string::npos) << none.sentence;
  EXPECT_EQ(none.sentence.find("No cause stands out"), std::string::npos) << none.sentence;
  const Judged named = with_vibration({.status = "identified", .effects = {"rotor_tilt"}}, one_of_four());
  EXPECT_EQ(named.status, "unknown");
  EXPECT_TRUE(named.effects.empty());
  EXPECT_EQ(named.confused_with, std::vector<std::string>{"rotor_tilt"});
  const Judged drag = with_vibration({.status = "identified", .effects = {"rotor_drag"}}, one_of_four());
  EXPECT_EQ(drag.status, "partly") << "a propeller that shakes does not drag";
  EXPECT_EQ(drag.effects, std::vector<std::string>{"rotor_drag"});
  const Judged other = with_vibration({.status = "unknown", .sentence = "Something swings."}, one_of_four());
  EXPECT_NE(other.sentence.find("Something swings."), std::string::npos);
  EXPECT_NE(other.sentence.find("rotor 3"), std::string::npos);
}

TEST(WithVibration, AFlightOfShakenSensorsLacksNothingUnlessOneRotorShakesThem) {
  const Vehicle vehicle = testing::shaken_vehicle();
  const FlightLog quiet = flown(vehicle, 7, true);
  EXPECT_EQ(verdict_of(vehicle, quiet)["status"], "none");
  const auto all = verdict_of(vehicle, shaken(quiet, {0.8, 1.2, 0.7, 1.0}));
  EXPECT_EQ(all["status"], "none") << all;
  const auto one = verdict_of(vehicle, shaken(quiet, {0, 0, 0, 1.0}));
  EXPECT_EQ(one["status"], "unknown") << one;
  EXPECT_NE(one["sentence"].get<std::string>().find("rotor 4"), std::string::npos) << one;
}

}  // namespace
}  // namespace ident
