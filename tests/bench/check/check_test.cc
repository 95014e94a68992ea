// Physical consistency: the published vehicle, and one violation at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "ident/bench/check/consistency.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/result/findings.h"
#include "ident/views/findings_list.h"
#include "support/run_program.h"

namespace ident {
namespace {

std::string published(const std::string& name) {
  return std::string(IDENT_SOURCE_DIR) + "/data/published/" + name;
}

std::vector<std::string> codes(const Result& result) {
  std::vector<std::string> list;
  for (const auto& v : result.extra["violations"]) list.push_back(v["code"]);
  return list;
}

bool holds(const std::vector<std::string>& list, const std::string& code) {
  return std::ranges::find(list, code) != list.end();
}

// A 1 kg quadrotor that nothing is wrong with: hover at 638 rad/s = command 0.64, thrust to weight 2.45.
Vehicle sound_vehicle() {
  Vehicle v;
  v.layout = "plus";
  v.arm = 0.2;
  v.rotors = layout_rotors("plus", 0.2, 0.0);
  v.propeller_radius = 0.1;
  v.parameters = {{"m", {1.0, 0.001}},    {"kT", {6e-6, 5e-8}},  {"kQ", {9e-8, 1e-9}},
                  {"km", {1000, 10}},     {"Jxx", {8e-3, 1e-4}}, {"Jyy", {8e-3, 1e-4}},
                  {"Jzz", {14e-3, 2e-4}}, {"omega_m", {30, 1}},  {"zeta_m", {0.9, 0.05}},
                  {"ki", {0.01, 1e-4}},   {"kv", {0.0105, 1e-4}}};
  return v;
}

// MODEL: thrust to weight 0.62 at delta = 1, hover at delta = 1.27 and 666 rad/s, Jxx + Jyy = 2.115e-3
// < 2.423e-3.
TEST(Check, PublishedVehicleCannotHoverAndNoBodyHasItsInertia) {
  const Result result = check_consistency(read_vehicle(published("phang_4sp.yaml"), VehicleUse::judging));
  EXPECT_NEAR(result.extra["thrust_to_weight"].get<double>(), 0.62, 0.002);
  EXPECT_NEAR(result.extra["hover_command"].get<double>(), 1.27, 0.003);
  EXPECT_NEAR(result.extra["hover_rotor_speed"].get<double>(), 666, 1);
  EXPECT_EQ(codes(result),
            (std::vector<std::string>{"triangle_inequality", "cannot_hover", "hover_command_out_of_range"}));
  const auto& triangle = result.extra["violations"][0]["values"];
  EXPECT_DOUBLE_EQ(triangle["sum"].get<double>(), 2.115e-3);
  EXPECT_DOUBLE_EQ(triangle["Jzz"].get<double>(), 2.423e-3);
}

TEST(Check, ItsFeasibleVersionHoversAtSixTenths) {
  const Result result = check_consistency(read_vehicle(published("phang_4sp_feasible.yaml")));
  EXPECT_TRUE(codes(result).empty());
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_NEAR(result.extra["hover_command"].get<double>(), 0.6, 0.002);
}

TEST(Check, ASoundVehicleHasNoFinding) {
  const Result result = check_consistency(sound_vehicle());
  EXPECT_TRUE(codes(result).empty()) << result.verdict;
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front().message;
  // m g/(4 kT) = 9.81/(24e-6) = 408750 = 639.3^2
  EXPECT_NEAR(result.extra["hover_rotor_speed"].get<double>(), 639.3, 0.1);
  EXPECT_NEAR(result.extra["thrust_to_weight"].get<double>(), 24.0 / 9.81, 1e-9);
}

struct Fault {
  std::string code;
  std::function<void(Vehicle&)> make;
};

TEST(Check, EveryFaultIsNamed) {
  const std::vector<Fault> faults = {
      {"out_of_range",
       [](Vehicle& v) {
         v.parameters["kT"] = {-6e-6, {}};
       }},
      {"out_of_range", [](Vehicle& v) { v.parameters["kT"].value = kNaN; }},
      {"out_of_range", [](Vehicle& v) { v.parameters["m"].value = 1000; }},
      {"out_of_range", [](Vehicle& v) { v.parameters["zeta_m"].value = 0; }},
      {"out_of_range", [](Vehicle& v) { v.parameters["dead_time"].value = -0.01; }},
      {"out_of_range", [](Vehicle& v) { v.parameters["rotor_drag.kd"].value = -1e-5; }},
      {"bad_std", [](Vehicle& v) { v.parameters["kQ"].std = -1.0; }},
      {"inertia_not_positive", [](Vehicle& v) { v.parameters["Jxy"].value = 9e-3; }},
      {"triangle_inequality", [](Vehicle& v) { v.parameters["Jzz"].value = 17e-3; }},
      {"triangle_inequality", [](Vehicle& v) { v.parameters["Jxz"].value = 3e-3; }},
      {"implausible_inertia", [](Vehicle& v) { v.parameters["m"].value = 0.05; }},
      {"cannot_hover", [](Vehicle& v) { v.parameters["km"].value = 600; }},
      {"hover_command_out_of_range", [](Vehicle& v) { v.parameters["km"].value = 600; }},
      {"no_hover_trim",
       [](Vehicle& v) {
         for (Rotor& r : v.rotors) r.s = 1;
       }},
      {"no_hover_trim", [](Vehicle& v) { v.parameters["cg_offset.x"].value = 0.25; }},
      {"implausible_torque_ratio", [](Vehicle& v) { v.parameters["kQ"].value = 9e-7; }},
      {"figure_of_merit", [](Vehicle& v) { v.parameters["kQ"].value = 4e-8; }},
      {"tip_speed", [](Vehicle& v) { v.parameters["km"].value = 4000; }},
      {"motor_constants", [](Vehicle& v) { v.parameters["kv"].value = 1.0; }},
      {"rotor_pushes_down",
       [](Vehicle& v) {
         v.rotors[2].a_B = {0, 0, 1};
       }},
  };
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Vehicle v = sound_vehicle();
    faults[i].make(v);
    const std::vector<std::string> found = codes(check_consistency(v));
    EXPECT_TRUE(holds(found, faults[i].code))
        << i << " " << faults[i].code << ": " << testing::PrintToString(found);
  }
}

// A file may place every rotor and state no arm: what units slip in is as wrong there.
TEST(Check, RotorsPlacesSayHowLargeAVehicleIs) {
  Vehicle v = sound_vehicle();
  v.arm.reset(), v.parameters.erase("l");
  EXPECT_TRUE(codes(check_consistency(v)).empty());
  for (const char* name : {"Jxx", "Jyy", "Jzz"}) v.parameters[name].value *= 1e4;  // kg cm^2 for kg m^2
  EXPECT_TRUE(holds(codes(check_consistency(v)), "implausible_inertia"));
}

TEST(Check, ATriangleWithinItsUncertaintyIsADoubtOnly) {
  Vehicle v = sound_vehicle();
  v.parameters["Jzz"] = {16.1e-3, 2e-4};  // 0.1e-3 above the sum, whose standard deviation is 0.245e-3
  const Result result = check_consistency(v);
  EXPECT_TRUE(codes(result).empty());
  EXPECT_TRUE(result.has_warning("triangle_inequality"));
}

TEST(Check, WhatTheFileDoesNotSayIsNotJudged) {
  Vehicle v;
  v.parameters = {{"kT", {6e-6, {}}}};
  const Result result = check_consistency(v);
  EXPECT_TRUE(codes(result).empty());
  EXPECT_TRUE(result.extra["thrust_to_weight"].is_null());
  EXPECT_TRUE(result.extra["hover_command"].is_null());
}

TEST(Check, ASlantThatIsOffIsADoubt) {
  Vehicle v = read_vehicle(published("phang_4sp_feasible.yaml"));
  v.parameters["alpha"].value += 0.02;
  EXPECT_TRUE(check_consistency(v).has_warning("slant_not_optimal"));
}

TEST(CheckProgram, EndsWithOneAndItsJsonOnAViolation) {
  const ProgramRun bad = run_ident({"check", published("phang_4sp.yaml"), "--json"});
  EXPECT_EQ(bad.status, 1);
  const auto json = nlohmann::json::parse(bad.out);
  EXPECT_EQ(json["command"], "check");
  EXPECT_EQ(json["violations"].size(), 3u);
  const ProgramRun good = run_ident({"check", published("phang_4sp_feasible.yaml"), "--json"});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_TRUE(nlohmann::json::parse(good.out)["violations"].empty());
  EXPECT_EQ(run_ident({"check", "nowhere.yaml"}).status, 2);
}

TEST(CheckProgram, ListsEveryFindingAsTextAsJsonAndAsAPage) {
  const ProgramRun text = run_ident({"check", "--list"});
  EXPECT_EQ(text.status, 0) << text.err;
  for (const FindingInfo& finding : all_findings())
    EXPECT_NE(text.out.find("\n" + std::string(finding.code) + " "), std::string::npos) << finding.code;
  const auto json = nlohmann::json::parse(run_ident({"check", "--list", "--json"}).out);
  ASSERT_EQ(json["findings"].size(), all_findings().size());
  for (const char* key : {"code", "stage", "seen", "consequence", "advice"})
    EXPECT_FALSE(json["findings"][0][key].get<std::string>().empty()) << key;
  const std::string folder = test_folder();
  EXPECT_EQ(run_ident({"check", "--list", "--markdown", "page.md"}, folder).status, 0);
  std::ifstream page(folder + "/page.md");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(page), {}), findings_page());
  EXPECT_EQ(run_ident({"check", "--list", published("phang_4sp.yaml")}).status, 2);
  EXPECT_EQ(run_ident({"check", "--markdown", "page.md"}, folder).status, 2);
}

}  // namespace
}  // namespace ident
