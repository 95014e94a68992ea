// Status, names, rest and findings; evidence beside each candidate.
#include "ident/gap/views/verdict_json.h"

#include <algorithm>

#include "ident/gap/views/gap_sections.h"
#include "ident/gap/views/gap_where.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Json interval(const Share& share) { return {number_or_null(share.ci95[0]), number_or_null(share.ci95[1])}; }

// First entry of a ranked list of `where`, if it has one.
Json first_of(const Json& where, const char* list) {
  return where.contains(list) && !where[list].empty() ? where[list][0] : Json(nullptr);
}

// The band with the largest share.
Json loudest_band(const Json& where) {
  Json out;
  for (const Json& band : where["bands"])
    if (out.is_null() || band["share"].get<double>() > out["share"].get<double>()) out = band;
  return out;
}

Json remaining_of(const Judged& verdict) {
  Json out{{"share", number_or_null(verdict.remaining.value)},
           {"share_ci95", interval(verdict.remaining)},
           {"probability", verdict.rest.probability},
           {"predictable", verdict.rest.predictable},
           {"description", verdict.rest.said()}};
  Json signs = Json::array();
  for (const Sign& sign : verdict.rest.signs)
    signs.push_back({{"what", sign.said}, {"log_odds", sign.log_odds}});
  out["signs"] = signs;
  return out;
}

Json why(const JudgedCause& cause) {
  const NameEvidence& x = cause.evidence;
  return {{"in_sets", cause.in_sets},
          {"right", cause.right},
          {"left", x.left},
          {"varies", x.varies},
          {"closes", x.closes},
          {"told", x.told},
          {"minor", x.minor},
          {"share", x.share},
          {"beyond", x.beyond},
          {"told_from_none", x.told_from_none},
          {"beside_left_out", x.beside_left_out},
          {"seen", x.seen}};
}

}  // namespace

Json to_json(const Judged& verdict) {
  Json out = {{"status", verdict.status},
              {"effects", verdict.effects},
              {"confused_with", verdict.confused_with},
              {"sentence", verdict.sentence},
              {"remaining", remaining_of(verdict)}};
  Json findings = Json::array();
  for (const Contradiction& one : verdict.findings)
    findings.push_back({{"constant", one.constant},
                        {"stated", number_or_null(one.stated)},
                        {"found", number_or_null(one.found)},
                        {"std", number_or_null(one.std)},
                        {"unit", one.unit},
                        {"deviations", number_or_null(one.deviations)}});
  out["findings"] = findings;
  return out;
}

Json to_json(const Judged& verdict, const ResidualWrench& left) {
  Json out = to_json(verdict);
  const Json where = where_json(left);
  Json& remaining = out["remaining"];
  remaining["where"] = first_of(where, "channels");
  remaining["when"] = first_of(where, "times");
  remaining["band"] = loudest_band(where);
  return out;
}

void enter_causes(Json& candidates, const Judged& verdict) {
  for (Json& c : candidates) {
    const auto cause = std::ranges::find_if(
        verdict.causes, [&](const JudgedCause& one) { return one.evidence.name == c["effect"]; });
    if (cause == verdict.causes.end()) continue;
    c["probability"] = cause->probability();
    c["share"] = number_or_null(cause->share.value);
    c["share_ci95"] = interval(cause->share);
    c["why"] = why(*cause);
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Json& a, const Json& b) {
    return a["probability"].get<double>() > b["probability"].get<double>();
  });
}

}  // namespace ident
