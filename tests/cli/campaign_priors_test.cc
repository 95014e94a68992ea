// What one command of a campaign leaves for the next: each thing that was measured counts once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/run_program.h"

namespace ident {
namespace {

const std::string kData = std::string(IDENT_SOURCE_DIR) + "/data";

class CampaignPriors : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test_folder();
    run({"simulate", "thrust", "--vehicle", kData + "/sample_truth/falcon_truth.yaml", "--output",
         "sweep.csv"});
    state_mass("0.5");
    for (const char* seed : {"1", "2"})
      run({"simulate", "flight", "--vehicle", kData + "/sample_truth/falcon_truth.yaml", "--output",
           std::string("flight") + seed + ".csv", "--duration", "8", "--rate", "100", "--seed", seed});
  }

  std::string run(const std::vector<std::string>& arguments) {
    const ProgramRun result = run_ident(arguments, folder_);
    EXPECT_EQ(result.status, 0) << arguments.front() << ": " << result.err;
    return result.out + result.err;
  }
  std::string refine(const std::string& log) {
    write_text(folder_, "ident.yaml", "vehicle: quad.yaml\nthrust: sweep.csv\nlogs: " + log + "\n");
    return run({"flightlog", "--refine"});
  }
  void state_mass(const std::string& value) {
    write_text(
        folder_, "quad.yaml",
        "command: {min: 1100, max: 1940}\nlayout: 4sp\narm: 0.17\nslant_deg: 9.6\nmass: {value: " + value +
            ", std: 0.001}\nparameters:\n"
            "  kT: {value: 6.2e-6, std: 6.0e-7}\n  kQ: {value: 8.5e-8, std: 9.0e-9}\n"
            "  km: {value: 780, std: 40}\n  omega_m: {value: 28, std: 3}\n"
            "  zeta_m: {value: 0.85, std: 0.1}\n  Jxx: {value: 2.9e-3, std: 3.0e-4}\n"
            "  Jyy: {value: 3.1e-3, std: 3.0e-4}\n  Jzz: {value: 5.5e-3, std: 5.0e-4}\n"
            "  dead_time: {value: 0.004, std: 0.001}\n");
  }
  std::string read(const std::string& file) {
    std::ifstream in(folder_ + "/" + file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  Known stored(const std::string& name) {
    return read_vehicle(folder_ + "/parameters.yaml").parameters.at(name);
  }

  std::string folder_;
};

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(CampaignPriors, AMassThatIsCorrectedIsFollowed) {
  refine("flight1.csv");
  EXPECT_NEAR(stored("m").value, 0.5, 0.001);
  state_mass("0.52");
  EXPECT_TRUE(says(run({"flightlog"}), "stated_otherwise"));
  EXPECT_FALSE(says(refine("flight1.csv"), "stated_otherwise"));
  EXPECT_NEAR(stored("m").value, 0.52, 0.001);
}

TEST_F(CampaignPriors, ALogCountsOnce) {
  EXPECT_FALSE(says(refine("flight1.csv"), "counted_twice"));
  const double first = *stored("omega_m").std;
  EXPECT_FALSE(says(refine("flight2.csv"), "counted_twice"));
  EXPECT_LT(*stored("omega_m").std, 0.85 * first);
  EXPECT_FALSE(says(refine("flight2.csv"), "counted_twice")) << "again, from what was known before";
  EXPECT_TRUE(says(refine("flight1.csv"), "counted_twice"));
  std::filesystem::remove(folder_ + "/parameters.yaml");  // as that advises
  EXPECT_FALSE(says(refine("[flight1.csv, flight2.csv]"), "counted_twice"));
}

TEST_F(CampaignPriors, ABenchThatReplacesARefinementSaysSo) {
  write_text(folder_, "ident.yaml", "vehicle: quad.yaml\nthrust: sweep.csv\nlogs: flight1.csv\n");
  EXPECT_FALSE(says(run({"thrust"}), "refine_again"));
  const double bench = stored("kT").value;
  refine("flight1.csv");
  EXPECT_NE(stored("kT").value, bench);
  const std::string again = run({"thrust"});
  EXPECT_TRUE(says(again, "warning refine_again")) << again;
  EXPECT_EQ(stored("kT").value, bench);
  EXPECT_TRUE(says(run({"report"}) + read("report.md"), "refine_again"));
}

// Whatever else is run in between, the same logs give the same constants.
TEST_F(CampaignPriors, TheSameLogsTellTheSame) {
  refine("flight1.csv");
  const std::string once = read("parameters.yaml");
  run({"flightlog", "--refine", "--free", "Omega_0"});
  EXPECT_TRUE(says(read("parameters.yaml"), "Omega_0"));
  run({"flightlog", "--refine"});
  EXPECT_EQ(read("parameters.yaml"), once) << "a constant that was freed once is gone";
  run({"flightlog", "flight2.csv", "--refine"});
  run({"flightlog", "--refine", "--vehicle", "quad.yaml"});
  EXPECT_EQ(read("parameters.yaml"), once) << "of another log, of another vehicle";
  refine("./flight1.csv");
  EXPECT_EQ(read("parameters.yaml"), once) << "the same file by another name";
}

TEST_F(CampaignPriors, AMassThatIsExactNowIsTaken) {
  refine("flight1.csv");
  const std::string text = read("quad.yaml");
  std::string exact = text;
  exact.replace(text.find("{value: 0.5, std: 0.001}"), 24, "0.52");
  write_text(folder_, "quad.yaml", exact);
  refine("flight1.csv");
  EXPECT_FALSE(read_vehicle(folder_ + "/parameters.yaml").has("m"));
  EXPECT_NEAR(stored("kT").value / 6.1e-6, 1.04, 0.01);
}

// A line that somebody takes out stays out, and what was changed by hand stays.
TEST_F(CampaignPriors, AParameterFileMayBeEdited) {
  write_text(folder_, "ident.yaml", "vehicle: quad.yaml\nthrust: sweep.csv\nlogs: flight1.csv\n");
  run({"thrust"});
  refine("flight1.csv");
  Vehicle edited = read_vehicle(folder_ + "/parameters.yaml");
  edited.parameters.erase("kQ");
  edited.parameters["Jp"] = {2e-5, 1e-6};
  write_vehicle(folder_ + "/parameters.yaml", edited);
  const auto& prior = [&](const std::string& name) {
    return nlohmann::json::parse(
        run_ident({"flightlog", "--refine", "--json"}, folder_).out)["parameters"][name]["prior"];
  };
  EXPECT_NEAR(prior("Jp")["value"].get<double>(), 2e-5, 1e-12);
  EXPECT_NEAR(prior("kQ")["value"].get<double>(), 8.5e-8, 1e-15) << "as the vehicle file states it";
}

}  // namespace
}  // namespace ident
