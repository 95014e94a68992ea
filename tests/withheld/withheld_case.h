// One case of the campaign: vehicle, effects at drawn sizes, two flights, and how visible each effect is.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "known_before.h"
#include "simulate.h"

namespace withheld {

struct CaseOrder {
  std::string kind;                  // none, single, pair, outside
  std::vector<std::string> members;  // what is withheld; empty for none
  double size = 0;                   // wanted, in units of the detection limit; 0: drawn
  bool commands = true;              // are logged; without, rotor speeds always are
  bool estimator = false;            // shows attitude and velocity
  bool filtered = false;             // rates and specific force are
};

struct Withheld {
  Member member;
  double size = 0;              // in units of Member::apply
  double over_limit = 0;        // base parameters projected out
  double over_limit_joint = 0;  // the other member of a pair projected out as well
};

struct LookAlike {
  std::string effect;
  double left;  // size over limit of what remains once this other effect has explained what it can
};

struct Case {
  CaseOrder order;
  std::uint64_t seed = 0;
  int attempts = 0;
  Vehicle vehicle;
  Effects effects;
  Instruments instruments;
  std::array<FlightSettings, 2> settings;
  KnownBefore known;
  std::vector<Withheld> withheld;
  std::vector<LookAlike> look_alikes;  // catalogue effects, the most alike first
  std::vector<Flight> flights;
};

// What case number `index` of a campaign withholds: 7 none, 10 single, 4 pairs, 4 outside of every 25.
// Without commands in the logs nothing that acts between command and rotor speed is drawn.
CaseOrder campaign_order(std::uint64_t seed, int index, const std::string& only_kind, bool commands);

Case draw_case(std::uint64_t seed, int index, const CaseOrder& order);

// cases/NNNN/{vehicle.yaml,log1.csv,log2.csv} and truth/NNNN.json below `folder`.
void write_case(const Case& drawn, int index, const std::string& folder);

}  // namespace withheld
