// What a search saw on its way to a verdict, for who wants to know how it came about.
#pragma once

#include <span>

#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/gap/search/search_result.h"
#include "ident/gap/statistics/bursts.h"
#include "ident/gap/statistics/generic_rival.h"
#include "ident/gap/statistics/residual_wrench.h"
#include "ident/gap/statistics/spectral_line.h"
#include "ident/result/result.h"

namespace ident {

struct SearchSeen {
  const SearchResult& search;
  const ResidualWrench& wrench;  ///< of the base model: names of the channels
  const Rival& rival;
  std::span<const SpectralLine> lines;
  const Vibration& vibration;
  std::span<const Burst> bursts;
};

/// generic_rival, scatter, by_channel, usual_scatter, lines, vibration, bursts, search, level_thrust,
/// explained.
nlohmann::ordered_json search_details(const SearchSeen& seen);

}  // namespace ident
