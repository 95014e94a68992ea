// Draws vehicles whose layout the target can hold, effects of clear sizes, and wrong constants.
#include "mended_case.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace mended {

using withheld::Random;

namespace {

constexpr double kLogLength = 45;                        // s
constexpr double kSmallest = 0.3;                        // size of an effect, in units of Member::apply
constexpr double kLeastWrong = 0.05, kMostWrong = 0.30;  // of a constant, relative
constexpr std::array<const char*, 4> kTargets = {"gz", "px4-sih", "rotorpy", "mujoco"};

bool fits(const std::string& target, const std::string& layout) {
  if (target == "px4-sih") return layout == "x";
  return target != "rotorpy" || layout != "4sp";  // thrust axes of RotorPy are upright
}

// PX4's order: front right, rear left, front left, rear right. The generator has front left second.
void order_for_px4(withheld::Vehicle& v) { std::swap(v.rotors[1], v.rotors[2]); }

bool of_sensors(const std::string& name) { return name.rfind("imu_", 0) == 0 || name == "sensor_delay"; }

// Wind and a disc that flaps back act through rotor drag: beside it they are no effects of their own.
bool may_join(const std::vector<std::string>& names, const std::string& next) {
  const auto has = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
  if (has(next)) return false;
  if (of_sensors(next) && std::ranges::any_of(names, of_sensors)) return false;
  const std::set<std::string> dragging = {"rotor_drag", "wind", "blade_flapping"};
  return !dragging.contains(next) ||
         std::ranges::none_of(names, [&](const auto& name) { return dragging.contains(name); });
}

std::vector<std::string> draw_names(Random& random) {
  const auto& all = withheld::catalogue_names();
  const auto count = static_cast<std::size_t>(random.integer(2, 4));
  std::vector<std::string> names;
  while (names.size() < count) {
    const auto& next = all[static_cast<std::size_t>(random.integer(0, static_cast<int>(all.size()) - 1))];
    if (may_join(names, next)) names.push_back(next);
  }
  return names;
}

withheld::FlightSettings draw_settings(const Case& c, int log, Random& random) {
  withheld::FlightSettings s;
  s.plan.duration = kLogLength * random.uniform(0.95, 1.05);
  s.plan.liveliness = random.uniform(0.6, 1.4);
  s.charge = log == 0 ? random.uniform(0.75, 0.98) : random.uniform(0.3, 0.9);
  s.gusts.sigma = random.chance(0.8) ? random.log_uniform(0.03, 0.4) : 0.0;
  s.gusts.time = random.uniform(3, 12) / random.uniform(2, 5);
  for (const Present& p : c.present) {
    s.plan.near_ground |= p.member.plan.near_ground;
    s.delay_margin += p.member.delay_margin;
  }
  return s;
}

// Simulators refuse moments of inertia of which one is more than the sum of the others.
bool is_a_body(const Case& c) {
  const Eigen::Vector3d J = c.vehicle.J.cwiseProduct(
      Eigen::Vector3d(c.wrong_by.at("Jxx"), c.wrong_by.at("Jyy"), c.wrong_by.at("Jzz")));
  return 2 * J.maxCoeff() < J.sum();
}

Case draw_scene(std::uint64_t seed, const std::string& target) {
  Case c;
  c.target = target, c.seed = seed;
  Random random(seed);
  do c.vehicle = withheld::draw_vehicle(random);
  while (!fits(target, c.vehicle.layout));
  if (target == "px4-sih") order_for_px4(c.vehicle);
  for (const std::string& name : draw_names(random))
    c.present.push_back({withheld::draw_member(name, c.vehicle, random), random.log_uniform(kSmallest, 1)});
  c.instruments = withheld::draw_instruments(c.vehicle, random);
  c.instruments.pulse_widths = false;  // a simulator's file states none
  for (std::size_t log = 0; log < c.settings.size(); ++log)
    c.settings[log] = draw_settings(c, static_cast<int>(log), random);
  c.effects.gust_grip = random.uniform(0.15, 0.4);
  c.effects.gust_arm = 0.03 * c.vehicle.arm;
  do {
    for (const std::string& name : withheld::base_parameter_names())
      c.wrong_by[name] = 1 + random.sign() * random.uniform(kLeastWrong, kMostWrong);
  } while (!is_a_body(c));
  c.wrong_by["zeta_m"] = 1;  // the file holds one lag, 2 zeta_m/omega_m
  for (const Present& p : c.present) {
    p.member.accompany(c.effects);
    p.member.apply(c.effects, p.size);
  }
  return c;
}

bool fly_all(Case& c) {
  double reference = 0;
  for (std::size_t log = 0; log < c.flights.size(); ++log) {
    c.flights[log] = withheld::fly(c.vehicle, c.effects, c.instruments, c.settings[log], c.seed,
                                   static_cast<int>(log), reference);
    reference = c.flights.front().reference_voltage;
    if (!c.flights[log].flown) return false;
  }
  return true;
}

}  // namespace

Case draw_case(std::uint64_t seed, int index) {
  constexpr int kAttempts = 64;
  const std::string target = kTargets[static_cast<std::size_t>(index - 1) % kTargets.size()];
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::uint64_t scene =
        seed * 2000003ULL + static_cast<std::uint64_t>(index) * 64ULL + static_cast<std::uint64_t>(attempt);
    Case c = draw_scene(scene, target);
    c.attempts = attempt + 1;
    if (fly_all(c)) return c;
  }
  throw std::runtime_error("no flights of case " + std::to_string(index) + " could be flown");
}

}  // namespace mended
