// The motor estimator on the step recording of a real speed controller.
#include <gtest/gtest.h>

#include <ctime>

#include "ident/bench/motor/motor_step.h"
#include "ident/io/csv/read_table.h"
#include "ident/io/csv/table_schemas.h"
#include "support/real_data.h"

namespace ident {
namespace {

/// "Rise" is the time constant up: from the edge of the command to 63 % of the way, as a motor of first order
/// has it. Others read 33 ms up and 40 ms down from this recording (the README beside it).
TEST(RealMotorSteps, RiseNear33MillisecondsAndSpinDownSlower) {
  IDENT_NEEDS_REAL_DATA(folder);
  const NumberTable table = read_table(folder + "/bench/esc_test/f40_steps_5-2.csv", motor_schema());
  const std::clock_t begin = std::clock();
  const Result result = estimate_motor({table});
  const double processor_time = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  const auto& spin = result.extra["spin"];
  const double up = spin["time_constant_up"]["value"], down = spin["time_constant_down"]["value"];
  EXPECT_GT(up, 0.028);
  EXPECT_LT(up, 0.038);
  EXPECT_GT(down, up);
  EXPECT_LT(down, 0.050);
  EXPECT_TRUE(result.has_warning("not_driven"));
  EXPECT_GE(result.find("dead_time")->value, 0.0);
  EXPECT_LT(processor_time, 10.0);  // 4 s measured
}

}  // namespace
}  // namespace ident
