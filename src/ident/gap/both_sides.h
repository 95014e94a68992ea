// What forces and moments along measured motion say together. Forces come first: what they tell of constants
// stays, and moments do not answer back.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/evidence/held_out_gap.h"
#include "ident/gap/verdict/verdict.h"
#include "ident/gap/windows/window_search.h"
#include "ident/gap/windows/window_shares.h"

namespace ident {

/// Of forces or of moments: what was found, and what is said of it.
struct Side {
  Side(const FlightRecord& record, FitTo what, std::vector<std::string> settled)
      : model(record, what, std::move(settled)) {}
  WindowModel model;
  WindowSearch search;
  std::vector<Parameter> parameters;
  WindowShares shares;
  Judged verdict;
  GapClosed gap;
  double missed = 0;  ///< share of the rates gained over a window that the model misses; 0 of forces

  /// Whether the inputs explain how the vehicle turned.
  bool explained() const;
};

/// Whether windows of that side tell something of a constant.
bool is_told(const Side& side, const std::string& name);

/// Whether a verdict names what is there.
bool is_sure(const Judged& verdict);

/// Whether moments tell a constant: their causes always, what else only where the inputs explain them.
bool tells(const Side& moments, const Side* forces, const FreeConstant& c);

/// The constants of both; either may be missing.
std::vector<Parameter> all_parameters_of(const Side* forces, const Side* moments);

/// A vehicle in which moments hardly move what forces tell.
Vehicle held_at(Vehicle vehicle, const Side& forces);

/// What both say. Of a side that is not sure beside one that is, only the sentence speaks.
Judged together(const Side* forces, const Side* moments);

/// The vehicle with what either side found. Constants that forces tell stay what these say.
Vehicle adopted_of(const Vehicle& vehicle, const Side* forces, const Side* moments);

}  // namespace ident
