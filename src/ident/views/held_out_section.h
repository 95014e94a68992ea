// Prediction of held-out flight by a refinement and by what was stated, as a section of a report.
#pragma once

#include <Eigen/Core>
#include <string>

#include "ident/flight/fit/held_out_validation.h"
#include "ident/result/result.h"
#include "ident/result/shown.h"

namespace ident {

/// Table of the errors; with traces of the channels that gain most if `shown` asks for pictures.
Section held_out_section(const Validation& validation, const FlightRecord& held_out, const Theta& theta,
                         const Eigen::VectorXd& before, const FlightFit& fit, Shown shown);

/// The same as JSON: a row for each horizon.
nlohmann::ordered_json held_out_json(const Validation& validation);

/// What a validation says in words where the stated constants predict better; else empty.
std::string predicts_worse_text(const Validation& validation);

}  // namespace ident
