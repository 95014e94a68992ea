// What a simulated flight does: where to be at any time, and what to add to the rotors' commands.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "ident/sim/controller.h"

namespace ident {

/// Names and meanings of the scenarios, the default first.
struct ScenarioInfo {
  std::string name, meaning;
};
std::span<const ScenarioInfo> scenarios();

/// The plan of one flight. Every manoeuvre starts and ends at rest above the start.
class Scenario {
 public:
  /// Throws UsageError for an unknown name. `seed` draws the phases of the multisine.
  Scenario(const std::string& name, double duration, const Plant& plant, const Trim& trim,
           const Agility& agility, double rate, std::uint64_t seed);

  Setpoint setpoint(double t) const;
  /// Adds the open-loop part to the commands.
  void excite(double t, std::span<double> delta) const;

  /// Height of the start above the ground, m.
  static constexpr double kHeight = 2.5;

 private:
  enum class Kind { multisine, steps, figure_eight, vertical, yaw, turn, opposing };
  struct Leg {
    Kind kind;
    double start = 0.0, duration = 0.0;
  };
  struct Tone {
    std::size_t rotor;
    double amplitude, frequency, phase;  ///< of delta, Hz, rad
  };
  struct Pose {
    Vec3<double> offset_W = Vec3<double>::Zero();
    double psi = 0.0;
  };
  void plan(const std::string& name, double duration);
  void plan_tones(const Plant& plant, const Trim& trim, double rate, std::uint64_t seed);
  const Leg* leg_at(double t) const;
  Pose pose(double t) const;
  Pose shuttle(const Leg& leg, double s) const;
  Pose eight(const Leg& leg, double s) const;

  Agility agility_;
  double low_ = 0.4;  ///< lowest height, m
  double ground_z_ = 0.0;
  double background_ = 0.0;  ///< share of the multisine that goes on all the time
  std::vector<Leg> legs_;
  std::vector<Tone> tones_;
  std::vector<std::vector<Tone>> opposing_;  ///< pairs of rotors, taken in turn
};

}  // namespace ident
