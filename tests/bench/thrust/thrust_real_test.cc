// Thrust stands as they are: recordings of others, read without editing. Skipped where they are not at hand.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "ident/bench/thrust/thrust_sweep.h"
#include "ident/core/error.h"
#include "ident/io/csv/read_table.h"
#include "ident/io/csv/table_schemas.h"
#include "support/real_data.h"

namespace ident {
namespace {

std::vector<std::string> files_of(const std::string& folder, const std::string& prefix) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(prefix) && name != "LICENSE" && !name.starts_with("f40"))
      files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

// The bounds: the same propeller on three motors.
TEST(RealThrust, EveryEscTestLogGivesItsConstantsAndItsMisfit) {
  IDENT_NEEDS_REAL_DATA(folder);
  for (const std::string& file : files_of(folder + "/bench/esc_test", "Log")) {
    const Result result = estimate_thrust({read_table(file, thrust_schema())});
    const double kT = result.find("kT")->value, kQ = result.find("kQ")->value;
    EXPECT_GT(kT, 4.2e-6) << file;
    EXPECT_LT(kT, 4.7e-6) << file;
    EXPECT_GT(kQ, 5.6e-8) << file;
    EXPECT_LT(kQ, 6.1e-8) << file;
    const auto& law = result.extra["quadratic_law"];
    EXPECT_GT(law["misfit_percent_fs"].get<double>(), 1.3) << file;
    EXPECT_LT(law["misfit_percent_fs"].get<double>(), 2.8) << file;
    EXPECT_LT(law["with_linear_term_percent_fs"].get<double>(), 0.6) << file;
    EXPECT_TRUE(result.has_warning("quadratic_law_misfit")) << file;
    EXPECT_TRUE(result.has_warning("separate_rows")) << file;
    EXPECT_TRUE(result.has_warning("speed_spikes")) << file;
    EXPECT_TRUE(result.has_warning("motor_not_identifiable")) << file;
    EXPECT_EQ(result.has_warning("reversed_torque"), file.find("171350") == std::string::npos) << file;
  }
}

TEST(RealThrust, EveryOtherFileIsFittedOrRefusedWithAReason) {
  IDENT_NEEDS_REAL_DATA(folder);
  for (const char* stand : {"strawson_1520", "uiuc_static"})
    for (const std::string& file : files_of(folder + "/bench/" + stand, "")) try {
        const Result result = estimate_thrust({read_table(file, thrust_schema())});
        const Parameter& kT = *result.find("kT");
        EXPECT_GT(kT.value, 0.0) << file;
        EXPECT_TRUE(std::isfinite(kT.std)) << file;
      } catch (const Error& error) {
        EXPECT_GT(std::string(error.what()).size(), 40u) << file;
      }
}

}  // namespace
}  // namespace ident
