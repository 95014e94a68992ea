// Where a search for causes stands, and what it has learnt on its way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ident/gap/search/model_search.h"

namespace ident {

struct SearchState {
  SearchState(const FlightRecord& record, const Vehicle& vehicle, const std::vector<double>& p,
              const SearchOptions& options);

  const FlightRecord& record;
  const Vehicle& vehicle;
  const std::vector<double>& p;
  const SearchOptions& options;
  FlightFitOptions fit;
  Standing now;
  std::vector<Candidate> kept;          ///< found before all others, never exchanged
  std::vector<Candidate> tried;         ///< and found no better where they act
  std::vector<Candidate> fell;          ///< whose fit ran away
  std::vector<Candidate> dropped;       ///< the others do their work
  std::optional<Standing> before_mass;  ///< where no cause that moves masses was in the model
  SearchResult out;

  const Candidate& candidate(int c) const { return now.problem.candidates[static_cast<std::size_t>(c)]; }
  /// Tells what is tried; `further`: share of the search beyond the causes found so far.
  void tell(double further, const std::string& what) const;
  Standing at(FittedModel model) const;
  /// Another model, of causes that were not added one by one.
  void move_to(Standing there);
  /// What each cause found gains beside the others.
  std::vector<SearchStep> steps_here() const;
  int of_vehicle(const std::vector<int>& set) const;
  /// Whether a set has no more causes than were asked for, and none with which no model can be fitted.
  bool may_be_tried(const std::vector<int>& set) const;
};

}  // namespace ident
