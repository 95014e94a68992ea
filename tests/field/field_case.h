// One case: a vehicle, what acts on it, what its file states, and three flights.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>

#include "flight.h"

namespace field {

struct Case {
  std::uint64_t seed = 0, index = 0;
  bool plain = false;
  std::string only;
  Vehicle v;
  Effects e;
  Stated stated;
  Tuning tuning;
  Instruments instruments;
  std::array<FlightSettings, 3> settings;  // the third is held out
  std::array<Flight, 3> flights;
};

// `only`: "" one in five plain; "plain", "full", or extras of effects.h, comma separated.
Case draw_case(std::uint64_t seed, std::uint64_t index, const std::string& only);
void fly_case(Case& c);

// Names of the catalogue that are right for this case: there and not stated, or implied by what is there.
std::set<std::string> names_present(const Case& c);
std::set<std::string> names_implied(const Case& c);
std::set<std::string> outside_present(const Case& c);

// Between which values a constant may honestly come out.
struct Range {
  double low, high;
};
std::map<std::string, Range> true_ranges(const Case& c);

void write_case(const Case& c, const std::string& folder);

}  // namespace field
