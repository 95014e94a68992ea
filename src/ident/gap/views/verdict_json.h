// A verdict as JSON: the answer, what is left, and what each cause found rests on.
#pragma once

#include <nlohmann/json.hpp>

#include "ident/gap/statistics/residual_wrench.h"
#include "ident/gap/verdict/verdict.h"

namespace ident {

/// `verdict` of a result. `left` is the residual with the causes found in the model: it says where, when and
/// in which band the rest lies.
nlohmann::ordered_json to_json(const Judged& verdict, const ResidualWrench& left);

/// The same where nothing is left to be described.
nlohmann::ordered_json to_json(const Judged& verdict);

/// Enters into `candidates` (as causes_tried gives them) probability, share and evidence of the causes found,
/// and puts the most probable first.
void enter_causes(nlohmann::ordered_json& candidates, const Judged& verdict);

}  // namespace ident
