// `ident thrust` as a user runs it: exit status, messages, campaign.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "ident/result/result.h"
#include "support/run_program.h"
#include "support/thrust_tables.h"

namespace ident {
namespace {

std::string csv(const NumberTable& table) {
  std::string text;
  for (const Column& c : table.columns) text += (text.empty() ? "" : ",") + c.name;
  text += "\n";
  for (std::size_t i = 0; i < table.rows(); ++i) {
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      text += (k ? "," : "") + std::to_string(table.columns[k].values[i]);
    text += "\n";
  }
  return text;
}

/// Six decimals are too few for a torque: thrust alone.
std::string thrust_csv() {
  NumberTable table = bench::SweepTable().table();
  bench::drop_column(table, "torque");
  return csv(table);
}

TEST(ThrustProgram, PrintsTheContractsJson) {
  const std::string file = write_text(test_folder(), "sweep.csv", thrust_csv());
  const ProgramRun run = run_ident({"thrust", file, "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["schema"], "ident.result/1");
  EXPECT_EQ(json["command"], "thrust");
  EXPECT_NEAR(json["parameters"]["kT"]["value"].get<double>() / 6e-6, 1.0, 0.02);
  EXPECT_EQ(json["parameters"]["kT"]["unit"], "N s^2/rad^2");
  EXPECT_EQ(json["parameters"]["kT"]["source"], "thrust");
  EXPECT_TRUE(json["quadratic_law"].contains("misfit_percent_fs"));
  EXPECT_TRUE(json["fit"]["rmse"].contains("thrust"));
}

TEST(ThrustProgram, AMissingColumnIsBadInputAndAnEmptyOneIsNotEnoughData) {
  const std::string folder = test_folder();
  const ProgramRun missing = run_ident({"thrust", write_text(folder, "a.csv", "omega,torque\n1,2\n")});
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("thrust"), std::string::npos) << missing.err;
  EXPECT_EQ(missing.out, "");
  const ProgramRun still =
      run_ident({"thrust", write_text(folder, "b.csv", "omega,thrust\n0,1\n0,2\n0,3\n0,4\n")});
  EXPECT_EQ(still.status, 1);
  EXPECT_NE(still.err.find("no usable rotor speed"), std::string::npos) << still.err;
  EXPECT_EQ(still.out, "");
}

TEST(ThrustProgram, ACampaignNeedsNoFileAndKeepsWhatWasFound) {
  const std::string folder = test_folder();
  write_text(folder, "sweep.csv", thrust_csv());
  write_text(folder, "v.yaml", "mass: 1.0\nlayout: plus\narm: 0.2\npropeller_radius: 0.1\n");
  write_text(folder, "ident.yaml", "vehicle: v.yaml\nparameters: found.yaml\nthrust: sweep.csv\n");
  const ProgramRun run = run_ident({"thrust", "--json"}, folder);
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_TRUE(json["parameters"].contains("CT"));
  EXPECT_NEAR(json["hover"]["thrust_per_rotor"].get<double>(), 9.81 / 4, 1e-9);
  const ProgramRun check = run_ident({"check", "--json"}, folder);
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_FALSE(nlohmann::json::parse(check.out)["hover_rotor_speed"].is_null());
}

TEST(ThrustProgram, TheReportShowsFitResidualsAndTheirDistribution) {
  const std::string folder = test_folder();
  write_text(folder, "sweep.csv", thrust_csv());
  ASSERT_EQ(run_ident({"thrust", "sweep.csv", "--report", "r.md"}, folder).status, 0);
  const ProgramRun run = run_ident({"thrust", "sweep.csv", "--report", "r.html"}, folder);
  EXPECT_EQ(run.status, 0) << run.err;
}

}  // namespace
}  // namespace ident
