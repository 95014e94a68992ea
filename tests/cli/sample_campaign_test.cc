// The campaign that ships in data/sample, run as a new user runs it, against the vehicle that it was made
// from.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(IDENT_SOURCE_DIR) / "data";

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A copy of the campaign as it was cloned, in the test's own folder.
fs::path fresh_campaign() {
  const fs::path folder = fs::path(test_folder()) / "campaign";
  fs::remove_all(folder);
  fs::copy(kData / "sample", folder, fs::copy_options::recursive);
  return folder;
}

void run(const fs::path& folder, const std::vector<std::string>& arguments) {
  const ProgramRun result = run_ident(arguments, folder.string());
  ASSERT_EQ(result.status, 0) << arguments.front() << ": " << result.err;
}

/// Every estimate that the truth knows lies within three of its standard deviations; how many there were.
int compare(const Vehicle& found, const Vehicle& truth) {
  int compared = 0;
  for (const auto& [name, known] : found.parameters) {
    if (!truth.has(name) || !known.std) continue;
    ++compared;
    EXPECT_LT(std::abs(known.value - truth.value(name)) / *known.std, 3.0)
        << name << " " << known.value << " +- " << *known.std << ", truth " << truth.value(name);
  }
  return compared;
}

TEST(SampleCampaign, BenchCommandsFindTheTruthAndTheReportTellsAllOfThem) {
  const fs::path folder = fresh_campaign();
  for (const char* command : {"thrust", "motor", "inertia", "slant", "check"}) run(folder, {command});
  run(folder, {"report", "--output", "report.html"});
  const Vehicle truth = read_vehicle((kData / "sample_truth/falcon_truth.yaml").string());
  const Vehicle found = read_vehicle((folder / "parameters.yaml").string());
  EXPECT_EQ(compare(found, truth), 9);  // kT kQ km omega_m zeta_m dead_time Jxx Jyy Jzz
  const Known slant = found.parameters.at("alpha_opt");
  const double best = std::atan(2 * truth.value("kQ") / (*truth.arm * truth.value("kT")));  // [Phang 24]
  EXPECT_LT(std::abs(slant.value - best) / *slant.std, 3.0);
  const std::string report = content(folder / "report.html");
  for (const char* name : {"kT", "kQ", "km", "omega_m", "zeta_m", "dead_time", "Jxx", "Jyy", "Jzz"})
    EXPECT_NE(report.find(name), std::string::npos) << name;
  const auto says_old = [&] {
    return run_ident({"report"}, folder.string()).out.find("run `ident slant` again") != std::string::npos;
  };
  EXPECT_FALSE(says_old());
  Vehicle later = found;
  later.parameters["kQ"].value *= 1.01;  // as a flight may say
  write_vehicle((folder / "parameters.yaml").string(), later);
  EXPECT_TRUE(says_old());
}

TEST(SampleCampaign, RefinementKeepsTheTruthWithinThreeStandardDeviations) {
  const fs::path folder = fresh_campaign();
  for (const char* command : {"thrust", "motor", "inertia"}) run(folder, {command});
  run(folder, {"flightlog", "--refine"});
  const Vehicle truth = read_vehicle((kData / "sample_truth/falcon_truth.yaml").string());
  const Vehicle found = read_vehicle((folder / "parameters.yaml").string());
  EXPECT_GE(compare(found, truth), 11);  // those of the bench, Jp and alpha
}

TEST(SampleCampaign, ALogThatWasRefinedFromIsNoPriorForItself) {
  const fs::path folder = fresh_campaign();
  write_text(folder.string(), "ident.yaml",
             "vehicle: falcon.yaml\nthrust: thrust_sweep.csv\ninertia: pendulum.csv\nlogs: short.csv\n");
  run(folder, {"simulate", "flight", "--vehicle", (kData / "sample_truth/falcon_truth.yaml").string(),
               "--output", "short.csv", "--duration", "8", "--rate", "100"});
  for (const char* command : {"thrust", "inertia"}) run(folder, {command});
  const std::string bench = content(folder / "parameters.yaml");
  run(folder, {"flightlog", "--refine"});
  const std::string once = content(folder / "parameters.yaml");
  run(folder, {"flightlog", "--refine"});
  EXPECT_NE(once, bench);
  EXPECT_EQ(content(folder / "parameters.yaml"), once);
}

TEST(SampleCampaign, TheScriptMakesTheSameFilesAgain) {
  const fs::path folder = fs::path(test_folder()) / "made";
  fs::create_directories(folder);
  const std::string command = "'" + (kData / "make_sample.sh").string() + "' '" + IDENT_PROGRAM + "' '" +
                              folder.string() + "' >/dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  int files = 0;
  for (const auto& made : fs::directory_iterator(folder)) {
    ++files;
    EXPECT_TRUE(content(made.path()) == content(kData / "sample" / made.path().filename())) << made.path();
  }
  EXPECT_EQ(files, 5);
}

}  // namespace
}  // namespace ident
