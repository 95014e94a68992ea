// Recordings of real thrust stands, read as they are. Skipped where they are not at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ident/io/csv/read_table.h"
#include "ident/io/csv/table_schemas.h"
#include "support/real_data.h"

namespace ident {
namespace {

std::size_t count_of(const NumberTable& table, std::string_view name) {
  const auto* values = table.find(name);
  return values ? static_cast<std::size_t>(
                      std::ranges::count_if(*values, [](double v) { return !std::isnan(v); }))
                : 0;
}

TEST(RealBench, Rcbenchmark1580HasThrustAndTorqueInDifferentRows) {
  IDENT_NEEDS_REAL_DATA(folder);
  const NumberTable table = read_table(folder + "/bench/esc_test/Log_2019-11-07_184325.csv", thrust_schema());
  EXPECT_EQ(table.find("omega"), nullptr);
  EXPECT_GT(count_of(table, "omega_electrical"), 1000u);
  EXPECT_EQ(count_of(table, "thrust"), 620u);  // counted with awk
  EXPECT_EQ(count_of(table, "torque"), 620u);
  EXPECT_EQ(table.find("u"), nullptr);
  const auto& thrust = *table.find("thrust");
  const auto& torque = *table.find("torque");
  for (std::size_t i = 0; i < table.rows(); ++i)
    EXPECT_TRUE(std::isnan(thrust[i]) || std::isnan(torque[i])) << i;
}

TEST(RealBench, GramsForceAndRevolutionsPerMinuteBecomeSi) {
  IDENT_NEEDS_REAL_DATA(folder);
  const NumberTable table = read_table(folder + "/bench/strawson_1520/a1_11.csv", thrust_schema());
  EXPECT_NEAR((*table.find("thrust"))[0], 15.171654199725802e-3 * 9.80665, 1e-12);
  EXPECT_NEAR((*table.find("omega_electrical"))[0], 3421 * 2 * M_PI / 60, 1e-9);
  EXPECT_EQ((*table.find("u"))[0], 1050);
  EXPECT_EQ(table.find("torque"), nullptr);
}

TEST(RealBench, ClockTimesOfAStepLogCountFromTheFirstRow) {
  IDENT_NEEDS_REAL_DATA(folder);
  const NumberTable table = read_table(folder + "/bench/esc_test/f40_steps_5-2.csv", motor_schema());
  const auto& t = *table.find("t");
  EXPECT_EQ(t[0], 0.0);
  EXPECT_NEAR(t[1], 0.001, 1e-9);
  EXPECT_NEAR(t[2], 0.005, 1e-9);
  EXPECT_EQ(t[3], t[2]);
  EXPECT_TRUE(
      std::ranges::any_of(table.warnings, [](const Warning& w) { return w.code == "time_repeated"; }));
  EXPECT_LE(*std::ranges::max_element(*table.find("delta")), 1.0);
  EXPECT_GT(*std::ranges::max_element(*table.find("delta")), 0.1);
}

// ance_8.5x6, first row: RPM 2489, CT 0.1046, CP 0.0567; n = 41.483/s, D = 0.2159 m:
// T = 0.1046*1.225*41.483^2*0.2159^4 = 0.47910 N, Q = 0.0567*1.225*41.483^2*0.2159^5/(2 pi) = 8.9239e-3 N m
TEST(RealBench, PropellerCoefficientsBecomeThrustAndTorque) {
  IDENT_NEEDS_REAL_DATA(folder);
  const NumberTable table =
      read_table(folder + "/bench/uiuc_static/ance_8.5x6_static_2848cm.txt", thrust_schema());
  EXPECT_NEAR((*table.find("thrust"))[0], 0.47910, 1e-4);
  EXPECT_NEAR((*table.find("torque"))[0], 8.9239e-3, 1e-5);
}

TEST(RealBench, EveryFileIsReadOrRefusedWithAReason) {
  IDENT_NEEDS_REAL_DATA(folder);
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder + "/bench")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".csv" && extension != ".txt") continue;
    const bool steps = entry.path().filename().string().starts_with("f40");
    EXPECT_NO_THROW(read_table(entry.path().string(), steps ? motor_schema() : thrust_schema()))
        << entry.path();
    ++read;
  }
  EXPECT_GE(read, 60);
}

}  // namespace
}  // namespace ident
