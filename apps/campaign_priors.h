// What a campaign knew of its vehicle before a flight: estimates that its logs gave are no priors for them.
#pragma once

#include <string>
#include <vector>

#include "ident/io/campaign/campaign.h"
#include "ident/io/campaign/flight_history.h"
#include "ident/result/result.h"

namespace ident::app {

/// The vehicle as it was known, and what a refinement of these logs will leave to the next.
struct CampaignPriors {
  Vehicle vehicle;
  FlightHistory history;  ///< all but `after`
  std::vector<std::string> notices;
  std::vector<Warning> warnings;
};

/// Where the stored refinement used one of these logs, what was known before it. Warns of logs that an
/// earlier one used (`counted_twice`).
CampaignPriors before_logs(const Campaign& campaign, const std::vector<CampaignLog>& logs);

/// A warning where a bench result is about to replace what a stored refinement found.
std::optional<Warning> replaces_refined(const Campaign& campaign, const Result& bench);

}  // namespace ident::app
