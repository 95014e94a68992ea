// Names the two models of the traces and asks for the channels in which the second gains most.
#include "ident/gap/evidence/evidence.h"

#include "ident/core/stage_times.h"
#include "ident/core/word_list.h"
#include "ident/views/prediction_traces.h"

namespace ident {
namespace {

constexpr std::size_t kChannelsShown = 2;

std::string name_of_found(const FittedModel& best) {
  std::vector<std::string> names;
  for (const Candidate& cause : best.adopted) names.push_back(described(cause));
  return names.empty() ? "refitted" : "with " + listed(names);
}

}  // namespace

GapEvidence evidence_of(const FlightRecord& record, const SearchResult& search, const HeldOutFlight& held_out,
                        Shown shown) {
  const Stage stage("signatures and pictures");
  GapEvidence evidence{{}, signatures(record, search)};
  if (shown != Shown::pictures) return evidence;
  std::vector<int> channels = channels_that_gain(held_out.errors_before, held_out.errors_after);
  channels.resize(std::min(channels.size(), kChannelsShown));
  const TracedModel given{"model as given", search.base.theta.get(), held_out.as_given},
      found{name_of_found(search.best), search.best.theta.get(), held_out.found};
  evidence.held_out = prediction_traces(held_out.record, given, found, held_out.noise, channels, {0.5, 1.0});
  return evidence;
}

}  // namespace ident
