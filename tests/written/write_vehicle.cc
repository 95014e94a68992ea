// Vehicle file with stated constants and their deviations, and the true constants as JSON.
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "case.h"
#include "random.h"

namespace written {
namespace {

struct Stated {
  const char* name;
  double truth, deviation;  // deviation relative to the value
};

}  // namespace

void write_vehicle(const std::string& folder, const Vehicle& v, std::uint64_t seed) {
  const Stated constants[] = {{"kT", v.kT, 0.08},           {"kQ", v.kQ, 0.10},         {"km", v.km, 0.06},
                              {"omega_m", v.omega_m, 0.15}, {"zeta_m", v.zeta_m, 0.10}, {"Jxx", v.J[0], 0.08},
                              {"Jyy", v.J[1], 0.08},        {"Jzz", v.J[2], 0.08},      {"Jp", v.Jp, 0.10}};
  nlohmann::json truth;
  truth["m"] = v.m;
  std::FILE* file = std::fopen((folder + "/vehicle.yaml").c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write in " + folder);
  std::fprintf(file,
               "# Rotors in the motor order of the log; constants as from a bench, off by 5 to 10 %%.\n");
  std::fprintf(file, "name: %s\ngravity: %.2f\nair: calm\nmass: {value: %.6g, std: %.3g}\nrotors:\n",
               v.name.c_str(), kGravity, v.m, 0.002 * v.m);
  for (const Rotor& rotor : v.rotors)
    std::fprintf(file, "  - {position: [%g, %g, %g], axis: [0, 0, -1], spin: %s}\n", rotor.r_B.x(),
                 rotor.r_B.y(), rotor.r_B.z(), rotor.s > 0 ? "ccw" : "cw");
  std::fputs("parameters:\n", file);
  Random random(seed ^ 0x57a7edu);
  for (const Stated& c : constants) {
    const double value = c.truth * (1 + random.sign() * random.uniform(0.6, 1.0) * c.deviation);
    std::fprintf(file, "  %s: {value: %.5g, std: %.3g}\n", c.name, value, c.deviation * c.truth);
    truth[c.name] = c.truth;
  }
  std::fclose(file);
  std::ofstream(folder + "/truth.json") << truth.dump(1) << '\n';
}

}  // namespace written
