// Prediction of held-out flight by the refined constants and by those stated.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"
#include "ident/result/shown.h"

namespace ident {

struct Validation {
  Section section;
  nlohmann::ordered_json horizons;  ///< error of both, floor and windows, a row for each
  std::string worse;                ///< said where the stated constants predict better; else empty
};

/// Errors over 0.1, 0.5 and 1 s of `held_out`, in standard deviations of the noise, by the constants at
/// `before` and by those of the fit; with pictures of the channels that gain most if `shown` asks for them.
Validation validate_refined(const FlightRecord& held_out, const Theta& theta, const Eigen::VectorXd& before,
                            const FlightFit& fit, Shown shown);

}  // namespace ident
