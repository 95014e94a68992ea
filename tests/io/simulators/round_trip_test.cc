// Export, import, export: every target that can be read, with every effect, keeps what it says it holds.
#include <gtest/gtest.h>

#include <cmath>

#include "ident/io/simulators/patch.h"
#include "ident/io/simulators/reduced.h"
#include "ident/io/simulators/simulators.h"
#include "io/simulators/simulator_vehicles.h"

namespace ident {
namespace {

using test::vehicles_with_effects;

// A file's numbers have 13 digits.
bool near(double a, double b) {
  return std::abs(a - b) <= 2e-12 * std::max(std::abs(a), std::abs(b)) + 1e-15;
}

void expect_same(const Vehicle& a, const Vehicle& b, bool exactly) {
  for (const auto& [name, known] : a.parameters) {
    ASSERT_TRUE(b.has(name)) << name << " is missing after the import";
    EXPECT_TRUE(exactly ? known.value == b.value(name) : near(known.value, b.value(name)))
        << name << ": " << known.value << " became " << b.value(name);
  }
  for (const auto& [name, known] : b.parameters)
    EXPECT_TRUE(a.has(name)) << name << " " << known.value << " came from nowhere";
  ASSERT_EQ(a.rotors.size(), b.rotors.size());
  for (std::size_t n = 0; n < a.rotors.size(); ++n) {
    const double tolerance = exactly ? 0.0 : 1e-12;
    EXPECT_LE((a.rotors[n].r_B - b.rotors[n].r_B).norm(), tolerance) << "hub " << n;
    EXPECT_LE((a.rotors[n].a_B - b.rotors[n].a_B).norm(), tolerance) << "axis " << n;
    EXPECT_EQ(a.rotors[n].s, b.rotors[n].s) << "spin " << n;
  }
}

class EveryTarget : public testing::TestWithParam<std::string> {
 protected:
  const SimulatorFormat& format() const { return find_simulator(GetParam()); }
  /// An airframe of PX4 alone is no vehicle: it has neither mass nor lags.
  bool whole() const { return format().recognises && GetParam() != "px4"; }
};

TEST_P(EveryTarget, IsReadBackAsTheVehicleThatItHolds) {
  if (!whole()) GTEST_SKIP();
  for (const Vehicle& v : vehicles_with_effects()) {
    const SimulatorExport made = export_to_simulator(format(), v);
    ASSERT_EQ(recognised_simulator(made.text), &format()) << made.text;
    expect_same(made.reduced, vehicle_of_simulator(format(), made.text, "made"), false);
    if (HasFailure()) FAIL() << made.text;
  }
}

TEST_P(EveryTarget, IsIdenticalAfterImportExportImport) {
  if (!whole()) GTEST_SKIP();
  for (const Vehicle& v : vehicles_with_effects()) {
    const Vehicle first = vehicle_of_simulator(format(), export_to_simulator(format(), v).text, "made");
    const Vehicle second = vehicle_of_simulator(format(), export_to_simulator(format(), first).text, "made");
    expect_same(first, second, true);
    if (HasFailure()) FAIL() << export_to_simulator(format(), first).text;
  }
}

TEST_P(EveryTarget, PatchesItsOwnFileWithoutChangingAByte) {
  if (!whole()) GTEST_SKIP();
  for (const Vehicle& v : vehicles_with_effects()) {
    const std::string text = export_to_simulator(format(), v).text;
    EXPECT_EQ(patch_simulator(format(), text, "own", v).text, text);
    const Vehicle imported = vehicle_of_simulator(format(), text, "own");
    EXPECT_EQ(patch_simulator(format(), text, "own", imported).text, text);
    if (HasFailure()) FAIL();
  }
}

TEST_P(EveryTarget, PatchedFileIsThatOfTheOtherVehicle) {
  if (!whole()) GTEST_SKIP();
  const std::string text = export_to_simulator(format(), test::plain_quadrotor()).text;
  for (const Vehicle& v : vehicles_with_effects()) {
    if (v.value("m") < 0.1 && GetParam().starts_with("gz"))
      continue;  // lighter than the file's rotor links allow
    const SimulatorExport patched = patch_simulator(format(), text, "own", v);
    expect_same(patched.reduced, vehicle_of_simulator(format(), patched.text, "own"), false);
    if (HasFailure()) FAIL() << patched.text;
  }
}

TEST_P(EveryTarget, SaysWhatItLeavesOut) {
  Vehicle v = test::plain_quadrotor();
  v.propeller_radius = 0.1;                // AirSim's coefficients need it
  v.parameters["wind.north"] = {3.0, {}};  // the one effect that no model of a vehicle holds
  const bool all = format().holds.everything;
  const std::vector<std::string> lost = export_to_simulator(format(), v).lost;
  const auto tells = [](const std::string& text) {
    return text.find("wind is left out (wind.north 3 m/s)") != std::string::npos;
  };
  EXPECT_NE(all, std::ranges::any_of(lost, tells));
}

std::vector<std::string> targets() {
  std::vector<std::string> names;
  for (const SimulatorFormat& format : simulator_formats()) names.emplace_back(format.target);
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& target) {
  std::string name = target.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Simulators, EveryTarget, testing::ValuesIn(targets()), test_name);

}  // namespace
}  // namespace ident
