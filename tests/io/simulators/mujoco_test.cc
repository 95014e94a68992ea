// The exported MJCF flown in MuJoCo itself, where libmujoco is installed.
#include <gtest/gtest.h>

#ifdef IDENT_HAVE_MUJOCO
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "ident/io/simulators/simulators.h"
#include "io/simulators/equations/by_thrust.h"
#include "io/simulators/simulator_vehicles.h"
#endif

namespace ident {
namespace {

#ifdef IDENT_HAVE_MUJOCO

constexpr double kRow = 2e-3, kStep = 5e-4;  // s

/// States after each row of a manoeuvre, forward, right, down.
test::Flown flown_by_mujoco(const std::string& text, const test::Manoeuvre& manoeuvre, double full_thrust) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("ident-" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << text;
  char error[1000] = "";
  mjModel* model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
  std::filesystem::remove(file);
  test::Flown out;
  EXPECT_NE(model, nullptr) << error;
  if (!model) return out;
  model->opt.timestep = kStep;
  mjData* data = mj_makeData(model);
  for (int n = 0; n < model->nu; ++n) {
    const double delta = manoeuvre.delta[0][static_cast<std::size_t>(n)];
    data->act[n] = full_thrust * delta * delta;
  }
  const double z = data->qpos[2];
  data->qvel[0] = manoeuvre.v_start.x(), data->qvel[1] = -manoeuvre.v_start.y(),
  data->qvel[2] = -manoeuvre.v_start.z();
  for (const std::vector<double>& delta : manoeuvre.delta) {
    for (int n = 0; n < model->nu; ++n)
      data->ctrl[n] = full_thrust * delta[static_cast<std::size_t>(n)] * delta[static_cast<std::size_t>(n)];
    for (int k = 0; k < static_cast<int>(kRow / kStep + 0.5); ++k) mj_step(model, data);
    const double *p = data->qpos, *v = data->qvel;
    Eigen::Matrix<double, 13, 1> line;
    line << p[0], -p[1], -(p[2] - z), v[0], -v[1], -v[2], p[3], p[4], -p[5], -p[6], v[3], -v[4], -v[5];
    out.push_back(line);
  }
  mj_deleteData(data), mj_deleteModel(model);
  return out;
}

// 1e-5: MuJoCo integrates the filter of the motors by the same Runge-Kutta, the other side solves it exactly.
TEST(MuJoCo, FliesTheExportedModelAsItsEquationsSay) {
  Vehicle v = test::plain_quadrotor();
  for (const auto& [name, value] :
       {std::pair("Jxy", 5e-5), {"Jxz", -4e-5}, {"Jyz", 3e-5}, {"rotor_tilt.x@3", 0.03}})
    v.parameters[name] = {value, {}};
  const SimulatorFormat& format = find_simulator("mujoco");
  const SimulatorExport made = export_to_simulator(format, v);
  const Fields fields = format.read(made.text, "made");
  const double full = fields.numbers("rotor1.ctrlrange", 2)[1];
  for (const test::Manoeuvre& manoeuvre :
       {test::hover_and_steps(made.reduced), test::fast_forward(made.reduced)})
    EXPECT_LT(test::largest_difference(flown_by_mujoco(made.text, manoeuvre, full),
                                       test::fly(test::mujoco_equations(fields, 4), manoeuvre)),
              1e-5);
}

#else

TEST(MuJoCo, FliesTheExportedModelAsItsEquationsSay) { GTEST_SKIP() << "libmujoco-dev is not installed"; }

#endif

}  // namespace
}  // namespace ident
