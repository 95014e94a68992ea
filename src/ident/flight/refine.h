// Refinement: all constants together from several logs, bench results as priors, and what these logs cannot
// tell.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "ident/data/flight_log.h"
#include "ident/flight/conditioning/rotor_vibration.h"
#include "ident/flight/fit/fit.h"
#include "ident/flight/fit/fitted_parameters.h"
#include "ident/flight/fit/prediction.h"
#include "ident/result/result.h"
#include "ident/result/shown.h"

namespace ident {

struct RefineOptions {
  std::vector<std::string> free;  ///< further constants to estimate, by name
  bool validate = true;           ///< prediction error on held-out flight, before and after
  Shown shown = Shown::pictures;  ///< sections beyond that are left out
  int bootstrap = 0;              ///< draws of a block bootstrap in place of the sandwich; 0: none
  std::function<void(double)> progress;
};

/// The same, of all rows.
Result refine_as_logged(const Vehicle& vehicle, std::span<const FlightLog> logs,
                        const RefineOptions& options);

}  // namespace ident
