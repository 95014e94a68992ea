// A campaign's results are kept, gathered in the order of the work, and checked against their inputs.
#include "ident/report/campaign_report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ident/core/error.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

class CampaignReport : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_ / ".ident");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void keep(const std::string& command, const std::vector<Parameter>& parameters, bool refine = false) {
    Result result;
    result.command = command;
    result.parameters = parameters;
    if (refine) result.command_line = {"ident", command, "--refine"};
    std::ofstream(stored_result_path(folder_.string(), result)) << stored_result_text(result);
  }

  fs::path folder_;
};

TEST_F(CampaignReport, GathersResultsInTheOrderOfTheWork) {
  keep("gap", {});
  keep("flightlog", {});
  keep("flightlog", {}, true);
  keep("thrust", {});
  const std::vector<Result> results = stored_results(folder_.string());
  ASSERT_EQ(results.size(), 4U);
  EXPECT_EQ(results[0].command, "thrust");
  EXPECT_EQ(results[1].command_line.size(), 3U);  // the refinement comes before the verification
  EXPECT_EQ(results[2].command, "flightlog");
  EXPECT_EQ(results[3].command, "gap");
}

TEST_F(CampaignReport, IsEmptyWhereNothingWasRun) {
  EXPECT_TRUE(stored_results((folder_ / "nowhere").string()).empty());
}

TEST_F(CampaignReport, NamesAFileThatIsNotWhole) {
  std::ofstream(folder_ / ".ident" / "motor.json") << "{\"schema\": ";
  try {
    stored_results(folder_.string());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("motor.json"), std::string::npos);
  }
}

TEST_F(CampaignReport, WarnsWhenAnInputHasChangedSince) {
  std::ofstream(folder_ / "sweep.csv") << "omega,thrust\n";
  Result result;
  result.command = "thrust";
  result.files = {{"sweep.csv", "0000"}};
  std::ofstream(stored_result_path(folder_.string(), result)) << stored_result_text(result);
  EXPECT_TRUE(stored_results(folder_.string()).at(0).has_warning("stale_result"));
}

TEST_F(CampaignReport, CountsTheLastResultOfAParameterUnlessItKnowsLess) {
  const Parameter bench{.name = "kT", .value = 6e-6, .std = 1e-7, .source = "thrust"};
  const Parameter flight{.name = "kT", .value = 6.1e-6, .std = 1e-8, .source = "flightlog"};
  const Parameter weak{.name = "kT", .value = 5e-6, .std = 1e-6, .identifiable = false, .source = "gap"};
  keep("thrust", {bench});
  keep("flightlog", {flight}, true);
  keep("gap", {weak});
  Vehicle vehicle;
  vehicle.parameters["m"] = {.value = 0.5, .std = 0.001};
  const Result summary = campaign_summary(vehicle, stored_results(folder_.string()));
  ASSERT_EQ(summary.parameters.size(), 2U);
  EXPECT_EQ(summary.find("kT")->source, "flightlog");
  EXPECT_EQ(summary.find("m")->source, "prior");
}

}  // namespace
}  // namespace ident
