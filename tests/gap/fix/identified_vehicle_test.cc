// What goes into the user's file: values that were identified, and no others.
#include "ident/gap/fix/identified_vehicle.h"

#include <gtest/gtest.h>

#include "ident/gap/fix/fix_view.h"
#include "io/simulators/simulator_vehicles.h"
#include "support/run_program.h"

namespace ident {
namespace {

using test::plain_quadrotor;

Diagnosis diagnosed(const Vehicle& adopted) {
  Diagnosis out;
  out.adopted = adopted;
  for (const auto& [name, known] : adopted.parameters) {
    Parameter p;
    p.name = name, p.value = known.value, p.std = known.std.value_or(0.0);
    out.result.parameters.push_back(p);
  }
  return out;
}

TEST(IdentifiedVehicle, KeepsWhatWasStatedOfWhatTheFlightsDoNotTell) {
  const Vehicle stated = plain_quadrotor();
  Vehicle adopted = stated;
  adopted.parameters["kT"] = {6.5e-6, 2e-8};
  adopted.parameters["Jzz"] = {9e-3, 4e-3};
  adopted.parameters["rotor_drag.kd"] = {6e-5, 1e-6};
  Diagnosis diagnosis = diagnosed(adopted);
  for (Parameter& p : diagnosis.result.parameters)
    if (p.name == "Jzz") p.doubt("not seen");
  const Vehicle out = identified_vehicle(stated, diagnosis);
  EXPECT_EQ(out.value("kT"), 6.5e-6);
  EXPECT_EQ(out.value("Jzz"), stated.value("Jzz"));
  EXPECT_EQ(out.value("rotor_drag.kd"), 6e-5);
}

TEST(FixedFile, OfASimulatorHoldsTheValuesAndTellsThem) {
  const std::string folder = test_folder();
  const Vehicle stated = plain_quadrotor();
  const std::string path =
      write_text(folder, "model.sdf", export_to_simulator(find_simulator("gz"), stated).text);
  Vehicle identified = stated;
  identified.parameters["rotor_drag.kd"] = {6e-5, 1e-6};
  identified.parameters["thrust_curve.c"] = {1e-4, 1e-5};
  const FixedFile fixed = fixed_file(path, stated, identified, {});
  const Vehicle again = vehicle_of_simulator(find_simulator("gz"), fixed.text, path);
  EXPECT_NEAR(again.value("rotor_drag.kd"), 6e-5, 1e-15);
  Diagnosis diagnosis;
  diagnosis.gap.before = 9.0, diagnosis.gap.after = 1.1, diagnosis.gap.floor = 1.0;
  enter_fix(diagnosis, fixed, path, "better.sdf");
  const Result& result = diagnosis.result;
  EXPECT_EQ(result.extra["fix"][0]["name"], "rotorDragCoefficient");
  EXPECT_TRUE(result.has_warning("left_out"));
  EXPECT_NE(result.verdict.find("misses 9 times"), std::string::npos) << result.verdict;
}

TEST(FixedFile, OfAVehicleFileIsWrittenAnewAndSaysSo) {
  const std::string folder = test_folder();
  const std::string path = write_text(folder, "v.yaml", "mass: 0.7\nlayout: x\narm: 0.2 # measured\n");
  Vehicle identified = plain_quadrotor(), stated = identified;
  identified.parameters["km"] = {800.0, 2.0};
  const FixedFile fixed = fixed_file(path, stated, identified, {});
  ASSERT_EQ(fixed.changes.size(), 1U);
  EXPECT_EQ(fixed.changes[0].name, "km");
  ASSERT_EQ(fixed.notes.size(), 1U);
  EXPECT_NE(fixed.notes[0].find("comments"), std::string::npos);
}

TEST(GapFix, NeedsTheFileThatIsToBePutRight) {
  const ProgramRun run = run_ident({"gap", "a.csv", "--fix", "better.sdf"}, test_folder());
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--fix needs --vehicle"), std::string::npos) << run.err;
}

TEST(GapSimulated, IsNotForAFileThatIsPutRight) {
  const ProgramRun run = run_ident(
      {"gap", "a.csv", "--vehicle", "v.yaml", "--fix", "b.yaml", "--simulated", "s.csv"}, test_folder());
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--simulated compares two vehicles"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace ident
