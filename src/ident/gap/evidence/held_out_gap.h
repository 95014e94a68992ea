// How far the gap closes on flight that was not fitted.
#pragma once

#include <vector>

#include "ident/flight/fit/prediction.h"
#include "ident/gap/evidence/evidence.h"
#include "ident/gap/search/search_result.h"

namespace ident {

/// Horizon (s) over which a gap is judged; the shortest where a flight in pieces has no room for it.
inline constexpr double kJudgedHorizon = 0.5;

/// Both models fitted to the first 70 % of each log, judged on the rest under the final noise.
struct HeldOutGap {
  FlightRecord record;            ///< the rest
  Eigen::VectorXd stated, found;  ///< unknowns: the base model as given, the model found
  PredictionOptions windows;      ///< over which both predict
  std::vector<std::vector<PredictionWindow>> before, after;  ///< a list for each horizon
  std::vector<GapClosed> horizons;
  GapClosed gap;              ///< over 0.5 s
  GapClosed judged;           ///< the same; over a shorter time where a flight in pieces has none as long
  std::size_t judged_at = 1;  ///< place of that horizon
};
HeldOutGap held_out_gap(const FlightRecord& record, const SearchResult& search);

/// The same of one of the causes found, by itself, over 0.5 s.
GapClosed closed_alone(const HeldOutGap& all, const SearchResult& search, const Candidate& cause);

/// The same windows, errors only.
PredictionOptions without_floors(PredictionOptions windows);

/// For pictures and signatures.
HeldOutFlight as_flight(const HeldOutGap& all, const NoiseModel& noise);

/// As `gap` of a result, with its `horizons`; `forces`, `moments` and `open_loop` say the same in the units
/// of what is predicted.
nlohmann::ordered_json as_json(const HeldOutGap& all, const SearchResult& search);

}  // namespace ident
