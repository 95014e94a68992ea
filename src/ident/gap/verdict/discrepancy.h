// Something else: how probable it is that a flight holds more than its model, its causes, and gusts.
#pragma once

#include <string>
#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/statistics/bursts.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/spectral_line.h"
#include "ident/gap/statistics/steadiness.h"

namespace ident {

/// What is left of a flight with the causes found in the model.
struct Rest {
  const GapClosed& gap;
  const Rival& rival;
  const std::vector<SpectralLine>& lines;
  const std::vector<Burst>& jumps;
  const std::vector<Unsteady>& unsteady;
  /// What the causes found gain, each beside the others, and what their forms leave of that to a regression.
  double explained = 0, by_form = 0;
  bool of_drive = false;  ///< a cause of the drive or of the motors is among them
  double left = 1;        ///< share of the gap that the causes found leave
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

  /// "a line at 12.1 Hz in Mx; jumps in Fz, most at 31 s of log 1"; empty where there is no sign.
  std::string said() const;
};

Discrepancy discrepancy(const Rest& rest);

}  // namespace ident
