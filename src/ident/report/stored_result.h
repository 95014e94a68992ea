// A result kept for a later report: everything in it as JSON, and back without loss.
#pragma once

#include "ident/result/result.h"

namespace ident {

/// All of `result`, sections and plots included. (`to_json` is the shorter form that users' scripts read.)
nlohmann::ordered_json stored_json(const Result& result);

/// The result that `stored_json` wrote, field by field the same, NaN and infinities included. Throws
/// nlohmann::json::exception on anything else.
Result result_from_json(const nlohmann::ordered_json& stored);

}  // namespace ident
