// One case: a true vehicle with two to four effects, three flights, and a simulator's constants that are
// wrong.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "../withheld/members.h"
#include "../withheld/simulate.h"

namespace mended {

constexpr int kShown = 2;  // flights that the user has; the last one is held out

struct Present {
  withheld::Member member;
  double size = 0;  // in units of Member::apply
};

struct Case {
  std::string target;  // gz, px4-sih, rotorpy, mujoco
  std::uint64_t seed = 0;
  int attempts = 0;
  withheld::Vehicle vehicle;
  withheld::Effects effects;
  std::vector<Present> present;
  withheld::Instruments instruments;
  std::array<withheld::FlightSettings, kShown + 1> settings;
  std::array<withheld::Flight, kShown + 1> flights;
  std::map<std::string, double> wrong_by;  // stated over true, by constant of the base model
};

// Case number `index` (from 1): targets take turns. Redraws what cannot be flown.
Case draw_case(std::uint64_t seed, int index);

// The vehicle file from which the user's simulator file is exported: true geometry, wrong constants.
std::string stated_vehicle(const Case& drawn, const std::string& name);

// cases/NNNN/{target, stated.yaml, log1.csv, log2.csv}, truth/NNNN.json and truth/NNNN_log3.csv.
void write_case(const Case& drawn, int index, std::uint64_t campaign_seed, const std::string& folder);

}  // namespace mended
