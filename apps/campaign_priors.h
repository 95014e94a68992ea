// What a campaign knew of its vehicle before a flight: estimates that its logs gave are no priors for them.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ident/core/result.h"
#include "ident/io/campaign.h"

namespace ident::app {

/// The vehicle as known, and where that comes from.
struct CampaignPriors {
  Vehicle vehicle;
  std::set<std::string> stated;        ///< parameters as the vehicle file states them
  std::vector<std::string> from_logs;  ///< logs that earlier refinements took what is known from
  std::vector<std::string> notices;
  std::vector<Warning> warnings;

  /// For the result that is stored, which the next refinement reads.
  nlohmann::ordered_json as_json() const;
};

/// As the campaign's files have it.
CampaignPriors as_stored(const Campaign& campaign);

/// As it was before `logs`: where the stored refinement used one of them, its estimates give way to what was
/// known before it. Warns of logs that an earlier one used (`counted_twice`).
CampaignPriors before_logs(const Campaign& campaign, const std::vector<CampaignLog>& logs);

/// Constants of a stored refinement that a bench result is about to replace, in words; empty for none.
std::string replaced_by_bench(const Campaign& campaign, const Result& bench);

}  // namespace ident::app
