// A user's own files with comments and odd layout: read by hand-computed values, patched without another byte
// changed.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <regex>

#include "ident/io/simulators/patch.h"
#include "ident/io/simulators/reduced.h"
#include "ident/io/simulators/simulators.h"
#include "io/simulators/simulator_vehicles.h"
#include "support/run_program.h"

namespace ident {
namespace {

std::string own_file(const std::string& name) {
  std::ifstream file(std::string(IDENT_SOURCE_DIR) + "/tests/io/simulators/own/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Vehicle imported(const std::string& name) {
  const std::string text = own_file(name);
  const SimulatorFormat* format = recognised_simulator(text);
  EXPECT_NE(format, nullptr) << name;
  EXPECT_TRUE(format == nullptr || name.starts_with(format->target))
      << name << " is taken for " << format->target;
  return format ? vehicle_of_simulator(*format, text, name) : Vehicle();
}

/// Lines that differ, as "old -> new" without indentation.
std::vector<std::string> changed_lines(const std::string& a, const std::string& b) {
  std::istringstream old_text(a), new_text(b);
  std::vector<std::string> out;
  const auto trimmed = [](const std::string& line) {
    return std::regex_replace(line, std::regex("^\\s+|\\s+$"), "");
  };
  for (std::string x, y; std::getline(old_text, x) && std::getline(new_text, y);)
    if (x != y) out.push_back(trimmed(x) + " -> " + trimmed(y));
  return out;
}

TEST(OwnFiles, GazeboModelIsOneBodyWithItsRotors) {
  const Vehicle v = imported("gz.sdf");
  const double rotor = 0.016076923076923075, m = 2 + 4 * rotor;
  EXPECT_NEAR(v.value("m"), m, 1e-12);
  const double c = 4 * rotor * 0.06 / m;  // above the base link; down is positive here
  EXPECT_NEAR(v.value("cg_offset.z"), -c, 1e-12);
  const double Jzz = 0.04 + 4 * (2.649858234714004e-05 + rotor * 2 * 0.174 * 0.174);
  EXPECT_NEAR(v.value("Jzz"), Jzz, 1e-12);
  const double Jxx = 0.02166666666666667 + 2 * c * c +
                     4 * (3.8464910483993325e-07 + rotor * (0.174 * 0.174 + (0.06 - c) * (0.06 - c)));
  EXPECT_NEAR(v.value("Jxx"), Jxx, 1e-12);
  EXPECT_NEAR(v.value("kT"), 8.54858e-06, 1e-18);
  EXPECT_NEAR(v.value("kQ"), 8.54858e-06 * 0.016, 1e-18);
  EXPECT_NEAR(v.value("km"), 1000, 1e-9);
  EXPECT_NEAR(v.value("Jp"), 2.649858234714004e-06, 1e-18);
  EXPECT_NEAR(motor_lags(v).up, 0.0125, 1e-12);
  EXPECT_NEAR(motor_lags(v).down, 0.025, 1e-12);
  // Plugins stand in the order 3, 0, 2, 1: the motors' numbers count. Front right is the first,
  // counter-clockwise.
  EXPECT_LT((v.rotors[0].r_B - Eigen::Vector3d(0.174, 0.174, -0.06)).norm(), 1e-12);
  EXPECT_EQ(v.rotors[0].s, 1);
  EXPECT_EQ(v.rotors[3].s, -1);
}

TEST(OwnFiles, RotorPyLiteralIsComputed) {
  const Vehicle v = imported("rotorpy.py");
  const double x = 0.043 * 0.70710678118;
  EXPECT_LT((v.rotors[1].r_B - Eigen::Vector3d(x, x, 0)).norm(), 1e-12);  // r2 is front right
  EXPECT_EQ(v.rotors[0].s, -1);  // direction 1 turns the body counter-clockwise
  EXPECT_DOUBLE_EQ(v.value("m"), 0.03);
  EXPECT_DOUBLE_EQ(v.value("rotor_drag.kd"), 10.2506e-07);
  EXPECT_DOUBLE_EQ(v.value("axial_inflow.kz"), 7.553e-07);
  EXPECT_NEAR(motor_lags(v).up, 0.072, 1e-12);
}

TEST(OwnFiles, UrdfIsPerRpm) {
  const Vehicle v = imported("urdf.urdf");
  const double per_rpm = std::numbers::pi / 30;
  EXPECT_NEAR(v.value("kT"), 3.16e-10 / (per_rpm * per_rpm), 1e-19);
  EXPECT_NEAR(v.value("km"), std::sqrt(2.25 * 0.027 * 9.8 / (4 * v.value("kT"))), 1e-8);
  EXPECT_NEAR(v.value("ground_effect.radius_sq"), 11.36859 * 2.31348e-2 * 2.31348e-2, 1e-14);
  EXPECT_GT(v.rotors[0].r_B.y(), 0.0);  // prop0 is right: its y is negative to the left
}

TEST(OwnFiles, MujocoThrustIsTheControl) {
  const Vehicle v = imported("mujoco.xml");
  EXPECT_NEAR(v.value("kT") * v.value("km") * v.value("km"), 13.0, 1e-10);
  EXPECT_NEAR(v.value("kQ") / v.value("kT"), 0.0201, 1e-12);
  EXPECT_EQ(v.rotors[0].s, 1);  // thrust1, rear right: a moment of -z turns the body clockwise
  EXPECT_NEAR(v.value("cg_offset.z"), -0.03, 1e-15);
}

TEST(OwnFiles, SihAndArduPilotKeepTheThrustAtFullCommand) {
  const Vehicle sih = imported("px4-sih.params");
  EXPECT_NEAR(sih.value("kT") * sih.value("km") * sih.value("km"), 5.0, 1e-10);
  EXPECT_NEAR(sih.value("kQ") / sih.value("kT"), 0.02, 1e-12);
  EXPECT_NEAR(sih.value("Kdx"), 1.0, 1e-15);
  const Vehicle ardupilot = imported("ardupilot.json");
  const double full = ardupilot.value("km") + ardupilot.value("Omega_0");
  EXPECT_NEAR(ardupilot.value("kT") * full * full, 3.0 * 9.80665 / (4 * 0.39), 1e-8);
  // Hover at the command where 0.35 c + 0.65 c^2 = 0.39.
  const double c = (-0.35 + std::sqrt(0.35 * 0.35 + 4 * 0.65 * 0.39)) / 1.3;
  EXPECT_NEAR(ardupilot.value("Omega_0") + ardupilot.value("km") * c, hover_speed(ardupilot), 1e-7);
  EXPECT_NEAR(ardupilot.command->min_us, 1150, 1e-9);
}

TEST(OwnFiles, CrazyflowPolynomialGivesThrustSlopeAndCurvatureAtHover) {
  const Vehicle v = imported("crazyflow.toml");
  const double a = -3.133427287299859e-7, b = 4.407354891648379e-10, T = 0.0434 * 9.81 / 4;
  const double rpm = (-a + std::sqrt(a * a + 4 * b * T)) / (2 * b);
  EXPECT_NEAR(hover_speed(v) * 30 / std::numbers::pi, rpm, 1e-6);
  EXPECT_NEAR(v.value("thrust_curve.c"), (a + 2 * b * rpm) * rpm / T - 2, 1e-9);
  EXPECT_NEAR(motor_lags(v).up, 1 / 20.0, 1e-12);
  EXPECT_NEAR(motor_lags(v).down, 1 / 12.5, 1e-12);
}

TEST(OwnFiles, AirframeGivesGeometryAndSaysThatMassIsMissing) {
  const Vehicle v = imported("px4.airframe");
  EXPECT_EQ(v.rotors.size(), 4U);
  EXPECT_LT((v.rotors[1].r_B - Eigen::Vector3d(-0.13, -0.20, 0)).norm(), 1e-12);
  EXPECT_EQ(v.rotors[2].s, -1);
  EXPECT_FALSE(v.has("m"));
}

class OwnFile : public testing::TestWithParam<std::string> {};

TEST_P(OwnFile, IsLeftAsItIsByItsOwnVehicle) {
  const std::string text = own_file(GetParam());
  const Vehicle v = imported(GetParam());
  if (!v.has("m")) GTEST_SKIP();
  EXPECT_EQ(patch_simulator(*recognised_simulator(text), text, GetParam(), v).text, text);
}

// What is left of both texts when every number is taken out is the same: comments, layout, names, order.
TEST_P(OwnFile, DiffersFromTheUsersOnlyInNumbers) {
  const std::string text = own_file(GetParam());
  const SimulatorFormat& format = *recognised_simulator(text);
  Vehicle v = imported(GetParam());
  if (!v.has("m")) GTEST_SKIP();
  for (const char* name : {"m", "Jxx", "Jyy", "Jzz", "kT", "kQ"}) v.parameters[name].value *= 1.07;
  const std::string patched = patch_simulator(format, text, GetParam(), v).text;
  EXPECT_NE(patched, text);
  const std::regex number(R"([-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)");
  EXPECT_EQ(std::regex_replace(patched, number, "#"), std::regex_replace(text, number, "#"));
  const Vehicle again = vehicle_of_simulator(format, patched, GetParam());
  EXPECT_NEAR(again.value("m"), v.value("m"), 1e-9 * v.value("m"));
  EXPECT_NEAR(again.value("Jxx"), v.value("Jxx"), 1e-9 * v.value("Jxx"));
}

INSTANTIATE_TEST_SUITE_P(Simulators, OwnFile,
                         testing::Values("gz.sdf", "gz-classic.sdf", "px4-sih.params", "px4.airframe",
                                         "ardupilot.json", "mujoco.xml", "rotorpy.py", "urdf.urdf",
                                         "crazyflow.toml"));

TEST(OwnFiles, OnlyThePatchedLineChanges) {
  const std::string text = own_file("rotorpy.py");
  Vehicle v = imported("rotorpy.py");
  v.parameters["kT"].value = 2.5e-8;
  v.rotors[0].r_B.x() += 0.001;
  const std::string patched = patch_simulator(find_simulator("rotorpy"), text, "rotorpy.py", v).text;
  const std::vector<std::string> lines = changed_lines(text, patched);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_TRUE(lines[0].starts_with(
      "'r1': d*np.array([ 0.70710678118, 0.70710678118, 0]), -> 'r1': np.array([0.031405591590"))
      << lines[0];
  EXPECT_EQ(lines[1],
            "'k_eta': 2.3e-08,           # thrust coefficient N/(rad/s)**2 -> 'k_eta': 2.5e-08,           # "
            "thrust coefficient "
            "N/(rad/s)**2");
}

// The form of PX4's x500: one file with the motors includes another one with the masses.
TEST(OwnFiles, AnIncludedModelBesideTheFolderCounts) {
  const std::string text = own_file("gz.sdf");
  const std::size_t plugins = text.find("    <plugin");
  const std::filesystem::path folder = test_folder();
  for (const char* name : {"mine", "mine_base"}) std::filesystem::create_directories(folder / name);
  const std::string file = (folder / "mine/model.sdf").string();
  const std::string top =
      "<sdf version='1.9'>\n  <model name='mine'>\n    <include "
      "merge='true'><uri>model://mine_base</uri></include>\n" +
      text.substr(plugins);
  std::ofstream(folder / "mine_base/model.sdf") << text.substr(0, plugins) << "  </model>\n</sdf>\n";
  const SimulatorFormat& format = find_simulator("gz");
  Vehicle v = vehicle_of_simulator(format, top, file);
  const Vehicle whole = imported("gz.sdf");
  ASSERT_EQ(v.parameters.size(), whole.parameters.size());
  for (const auto& [name, known] : whole.parameters) EXPECT_EQ(v.value(name), known.value) << name;
  // What stands in the other file is told, not changed.
  v.parameters["m"].value *= 1.1, v.parameters["kT"].value *= 1.1;
  const SimulatorExport patched = patch_simulator(format, top, file, v);
  EXPECT_EQ(changed_lines(top, patched.text).size(), 8U);  // motorConstant and momentConstant of four rotors
  ASSERT_FALSE(patched.notes.empty());
  EXPECT_NE(patched.notes[0].find("mine_base/model.sdf: patch that file too"), std::string::npos)
      << patched.notes[0];
}

TEST(OwnFiles, AMissingElementIsAddedBesideItsNeighbour) {
  const Vehicle v = imported("gz.sdf");
  std::string text = own_file("gz.sdf");
  const std::string line = "      <rotorDragCoefficient>8.06428e-05</rotorDragCoefficient>\n";
  text.erase(text.rfind(line), line.size());  // the plugin of one rotor states none: Gazebo takes 1e-4
  const SimulatorExport patched = patch_simulator(find_simulator("gz"), text, "gz.sdf", v);
  EXPECT_EQ(patched.text.size(), text.size() + line.size());
  EXPECT_NE(patched.text.find("<motorConstant>8.54858e-06</motorConstant>\n      "
                              "<rotorDragCoefficient>8.06428e-05</rotorDragCoefficient>\n"),
            std::string::npos);
}

}  // namespace
}  // namespace ident
