// The texts of the guide that put the full model into MuJoCo, run as they stand there.
//
// With the Python package mujoco they run on it. Without it, and with libmujoco, on a stand-in for the
// package: the few of its names that the guide uses, over the library. Without either the test is skipped.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "ident/io/simulators/simulators.h"
#include "ident/sim/plant.h"
#include "support/flown_vehicle.h"
#include "support/run_program.h"

namespace ident {
namespace {

namespace fs = std::filesystem;

/// The first block of fly.md in that language.
std::string block_of_guide(const std::string& language) {
  std::ifstream file(fs::path(IDENT_SOURCE_DIR) / "notebooks/guide/fly.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string fence = "```" + language + "\n";
  const std::size_t begin = text.find(fence) + fence.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

std::string output_of(const std::string& command, const std::string& folder) {
  std::string out;
  if (std::FILE* pipe = ::popen(("cd '" + folder + "' && " + command + " 2>&1").c_str(), "r")) {
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) out += buffer.data();
    EXPECT_EQ(::pclose(pipe), 0) << command << "\n" << out;
  }
  return out;
}

bool works(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

#ifdef IDENT_HAVE_MUJOCO
constexpr const char* kLibrary = R"(
#include <mujoco/mujoco.h>
mjModel* load(const char* file) { char e[999] = ""; return mj_loadXML(file, 0, e, sizeof e); }
mjData* make(const mjModel* m) { return mj_makeData(m); }
void step(const mjModel* m, mjData* d) { mj_step(m, d); }
int body(const mjModel* m, const char* name) { return mj_name2id(m, mjOBJ_BODY, name); }
double timestep(const mjModel* m) { return m->opt.timestep; }
double now(const mjData* d) { return d->time; }
double* qpos(mjData* d) { return d->qpos; }
double* qvel(mjData* d) { return d->qvel; }
double* xfrc(mjData* d) { return d->xfrc_applied; }
double* gain(const mjModel* m) { return m->actuator_gainprm; }
int gains(const mjModel* m) { return m->nu * mjNGAIN; }
)";

constexpr const char* kPackage = R"(
import ctypes
lib = ctypes.CDLL("./library.so")
P, D = ctypes.c_void_p, ctypes.POINTER(ctypes.c_double)
for name in ("load", "make"): getattr(lib, name).restype = P
for name in ("qpos", "qvel", "xfrc", "gain"): getattr(lib, name).restype = D
for name in ("timestep", "now"): getattr(lib, name).restype = ctypes.c_double
class mjtObj: mjOBJ_BODY = 1
class Gains:
    def __init__(self, p): self.p = p
    def __setitem__(self, every, value):
        for i in range(lib.gains(self.p)): lib.gain(self.p)[i] = value
class Options:
    def __init__(self, p): self.timestep = lib.timestep(p)
class MjModel:
    def from_xml_path(path):
        m = MjModel()
        m.p = P(lib.load(path.encode()))
        m.opt, m.actuator_gainprm = Options(m.p), Gains(m.p)
        return m
class Wrenches:
    def __init__(self, p): self.p = p
    def __setitem__(self, body, six):
        for i in range(6): lib.xfrc(self.p)[6 * body + i] = six[i]
class MjData:
    def __init__(self, m):
        self.p = P(lib.make(m.p))
        self.qpos, self.qvel, self.xfrc_applied = lib.qpos(self.p), lib.qvel(self.p), Wrenches(self.p)
    @property
    def time(self): return lib.now(self.p)
def mj_name2id(m, kind, name): return lib.body(m.p, name.encode())
def mj_step(m, d): lib.step(m.p, d.p)
)";

void write_stand_in(const std::string& folder) {
  write_text(folder, "library.c", kLibrary);
  write_text(folder, "mujoco.py", kPackage);
  output_of("cc -O1 -shared -fPIC library.c -o library.so -lmujoco", folder);
}
#endif

constexpr int kRows = 750;  // of 2 ms

// Commands of row i, the same text in Python and here.
constexpr const char* kManoeuvre = R"(
import math
import mujoco
from full_model import FullModel
model = mujoco.MjModel.from_xml_path("model.xml")
data = mujoco.MjData(model)
vehicle = FullModel(model)
for i in range(750):
    a, b, c = 0.01 * math.sin(0.02 * i), 0.012 * math.sin(0.013 * i), 0.05 * math.sin(0.01 * i)
    vehicle.step(model, data, [0.56 + a + b + c, 0.56 + a - b - c, 0.56 - a + b - c, 0.56 - a - b + c])
    if i % 50 == 49:
        print(*[repr(float(data.qpos[k])) for k in range(7)], *[repr(float(data.qvel[k])) for k in range(6)])
)";

std::vector<double> command_of(int i) {
  const double a = 0.01 * std::sin(0.02 * i), b = 0.012 * std::sin(0.013 * i), c = 0.05 * std::sin(0.01 * i);
  return {0.56 + a + b + c, 0.56 + a - b - c, 0.56 - a + b - c, 0.56 - a - b + c};
}

Vehicle with_all_that_the_header_holds() {
  Vehicle v = testing::flown_quad();
  for (const auto& [name, value] : {std::pair("rotor_drag.kd", 1.5e-4),
                                    {"parasitic_drag.C", 0.03},
                                    {"axial_inflow.kz", 1e-4},
                                    {"cg_offset.x", 0.002},
                                    {"Jxy", 1e-4},
                                    {"Jxz", -2e-4},
                                    {"blade_flapping.kf", 1e-6},
                                    {"rotor_mismatch.k1", 0.02},
                                    {"dead_time", 0.004}})
    v.parameters[name] = {value, {}};
  return v;
}

bool prepared(const std::string& folder) {
  if (!works("python3 -c 'import mujoco'")) {
#ifdef IDENT_HAVE_MUJOCO
    if (!works("python3 -c 'import ctypes'")) return false;
    write_stand_in(folder);
#else
    return false;
#endif
  }
  const Vehicle v = with_all_that_the_header_holds();
  write_text(folder, "model.xml", export_to_simulator(find_simulator("mujoco"), v).text);
  write_text(folder, "model.h", export_to_simulator(find_simulator("c99"), v).text);
  write_text(folder, "full_model.c", block_of_guide("c"));
  write_text(folder, "full_model.py", block_of_guide("python"));
  return true;
}

// Steps of 2 ms with the force of their middle: of second order, 1e-4 of what moves by metres.
TEST(MuJoCoGuide, TheFullModelFliesAsThePlantDoes) {
  const std::string folder = test_folder();
  if (!prepared(folder))
    GTEST_SKIP() << "neither the Python package mujoco nor libmujoco with Python is installed";
  write_text(folder, "manoeuvre.py", kManoeuvre);
  std::istringstream rows(output_of("python3 manoeuvre.py", folder));
  Plant plant(with_all_that_the_header_holds());
  const Vec3<double> rest = Vec3<double>::Zero();
  plant.start(-1e-9, {Vec4<double>(1, 0, 0, 0), rest, rest, Vec3<double>(0, 0, -1)},
              std::vector<double>(4, 0.0), std::vector<double>(4, 0.0));
  double worst = 0.0, furthest = 0.0;
  int compared = 0;
  for (int i = 0; i < kRows; ++i) {
    plant.command(2e-3 * i, command_of(i));
    plant.advance(2e-3 * (i + 1), 2.5e-4);
    if (i % 50 != 49) continue;
    std::array<double, 13> m{};
    for (double& number : m) rows >> number;
    const BodyState<double>& x = plant.state().body;
    const Vec3<double> at(m[0], -m[1], -m[2]), v(m[7], -m[8], -m[9]), w(m[10], -m[11], -m[12]);
    const Vec4<double> q(m[3], m[4], -m[5], -m[6]);
    worst = std::max({worst, (at - x.x_W).norm(), (v - x.v_W).norm(), (w - x.w_B).norm(),
                      std::min((q - x.q_WB).norm(), (q + x.q_WB).norm())});
    furthest = std::max(furthest, (x.x_W - Vec3<double>(0, 0, -1)).norm());
    ++compared;
  }
  EXPECT_EQ(compared, 15);
  EXPECT_GT(furthest, 1.0);
  EXPECT_LT(worst, 1e-3);
}

TEST(MuJoCoGuide, TheProgramOfTheGuideRunsAsItStands) {
  const std::string folder = test_folder();
  if (!prepared(folder))
    GTEST_SKIP() << "neither the Python package mujoco nor libmujoco with Python is installed";
  const std::string out = output_of("python3 full_model.py", folder);
  EXPECT_EQ(out.find("after 2.0"), 0U) << out;
}

TEST(MuJoCoGuide, TheCallBackIsShort) {
  const std::string text = block_of_guide("python");
  EXPECT_LE(std::ranges::count(text, '\n'), 52);
}

}  // namespace
}  // namespace ident
