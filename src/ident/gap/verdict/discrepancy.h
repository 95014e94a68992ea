// Something else: how probable it is that a flight holds more than its model, its causes, and gusts.
#pragma once

#include <string>
#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/statistics/bursts.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/spectral_line.h"

namespace ident {

/// What is left of a flight with the causes found in the model.
struct Rest {
  const GapClosed& gap;
  const Rival& rival;
  const std::vector<SpectralLine>& lines;
  const std::vector<Burst>& jumps;
  double explained = 0;  ///< fall of the cost by the causes found, each beside the others
};

/// One thing that gusts do not do.
struct Sign {
  double log_odds = 0;  ///< of something else against gusts, by this sign alone
  std::string said;     ///< a noun phrase: "a line at 12.1 Hz in Mx"
};

struct Discrepancy {
  double probability = 0;   ///< of something else
  double predictable = 0;   ///< share of what speaks for a lack in the model that no cause took up, 0 to 1
  std::vector<Sign> signs;  ///< those that make it probable, the strongest first
  bool stands_out = false;  ///< a line or jumps: it shows whatever its share

  /// "a line at 12.1 Hz in Mx; jumps in Fz, most at 31 s of log 1"; empty where there is no sign.
  std::string said() const;
};

/// `beside_causes`: gusts may follow the model's errors where causes were found, so the floor tells nothing.
Discrepancy discrepancy(const Rest& rest);

}  // namespace ident
