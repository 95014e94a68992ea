// A campaign's results are kept, gathered in the order of the work, and checked against their inputs.
#include "ident/report/campaign_report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "ident/core/error.h"
#include "ident/report/stored_result.h"

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

// kT of a flight that tells kT km^2 only: what the parameter file holds is shown, and it is known by the
// bench.
TEST_F(CampaignReport, ShowsWhatTheParameterFileHolds) {
  const Parameter bench{.name = "kT", .value = 6e-6, .std = 1e-7, .source = "thrust"};
  const Parameter both{.name = "kT",
                       .value = 6.1e-6,
                       .std = 9e-8,
                       .identifiable = false,
                       .source = "flightlog",
                       .note = "these logs say little",
                       .joint = true};
  keep("thrust", {bench});
  keep("flightlog", {both}, true);
  Vehicle vehicle;
  vehicle.parameters["kT"] = {both.value, both.std};
  const Parameter shown = *campaign_summary(vehicle, stored_results(folder_.string())).find("kT");
  EXPECT_EQ(shown.value, both.value);
  EXPECT_TRUE(shown.identifiable);
  EXPECT_EQ(shown.source, "thrust, flightlog");
  EXPECT_TRUE(shown.note.empty());
  vehicle.parameters["kT"] = {bench.value, bench.std};  // the sweeps were measured again
  EXPECT_EQ(campaign_summary(vehicle, stored_results(folder_.string())).find("kT")->value, bench.value);
}

TEST_F(CampaignReport, ReadsWhatAnOlderVersionStored) {
  Result result;
  result.command = "thrust";
  result.parameters = {{.name = "kT", .value = 6e-6, .std = 1e-7, .source = "thrust"}};
  nlohmann::ordered_json older = stored_json(result);
  older.erase("prior_correlation"), older.erase("prior_correlation_names");
  older["parameters"][0].erase("joint");
  EXPECT_EQ(result_from_json(older).find("kT")->value, 6e-6);
  older.erase("verdict");
  EXPECT_THROW(result_from_json(older), nlohmann::json::exception);
}

}  // namespace
}  // namespace ident
