// Quaternions whose columns are named wrongly are told from those that are not.
#include "ident/io/log/log_quaternion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ident/core/error.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "support/known_quad.h"

namespace ident {
namespace {

const FlightLog& right() {
  static const FlightLog log = testing::flight(testing::quad(), 200, 3, 20);
  return log;
}

/// Its columns hold what is in these of the right one.
FlightLog with_columns(std::array<std::size_t, 4> of) {
  FlightLog log = right();
  for (std::size_t k = 0; k < 4; ++k) log.q_WB[k] = right().q_WB[of[k]];
  return log;
}

FlightLog conjugated() {
  FlightLog log = right();
  for (std::size_t k = 1; k < 4; ++k)
    for (double& x : log.q_WB[k]) x = -x;
  return log;
}

std::string said_of(FlightLog log) {
  try {
    check_quaternion(log, 3);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(LogQuaternion, ARightOneIsLeftAlone) {
  FlightLog log = right();
  check_quaternion(log, 1);
  EXPECT_TRUE(log.warnings.empty());
}

TEST(LogQuaternion, TheOtherOrderOfItsComponentsIsNamed) {
  const std::string last = said_of(with_columns({1, 2, 3, 0}));  // qw holds x
  EXPECT_NE(last.find(":3: qw, qx, qy, qz: "), std::string::npos) << last;
  EXPECT_NE(last.find("x, y, z, w (scalar last) they do"), std::string::npos) << last;
  const std::string first = said_of(with_columns({3, 0, 1, 2}));
  EXPECT_NE(first.find("w, x, y, z (scalar first) they do"), std::string::npos) << first;
}

TEST(LogQuaternion, OfTheWorldInTheBodyLeavesNoNumberStanding) {
  FlightLog log = conjugated();
  check_quaternion(log, 1);
  ASSERT_EQ(log.warnings.size(), 1u);
  EXPECT_EQ(log.warnings[0].code, "wrong_frame");
  const Result result = refine_flight(testing::known(testing::quad()), std::vector{log}, {.validate = false});
  EXPECT_EQ(std::ranges::count(result.warnings, "wrong_frame", &Warning::code), 1);
  EXPECT_FALSE(result.has_warning("sign_flipped"));
  EXPECT_NE(result.verdict.find("conjugate it"), std::string::npos) << result.verdict;
  for (const Parameter& p : result.parameters) EXPECT_FALSE(p.identifiable) << p.name;
}

TEST(LogQuaternion, NothingIsSaidWhereNoReadingTurnsWithTheRates) {
  FlightLog log = with_columns({1, 2, 3, 0});
  for (auto& column : log.w_B)
    for (double& x : column) x *= 57.3;  // another check's
  check_quaternion(log, 1);
  for (auto& column : log.w_B) column.clear();
  check_quaternion(log, 1);
  EXPECT_TRUE(log.warnings.empty());
}

}  // namespace
}  // namespace ident
