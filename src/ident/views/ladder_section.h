// The ladder of models as a table and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "ident/flight/ladder/ladder.h"
#include "ident/result/result.h"

namespace ident {

/// A rung in words: "thrust and drag".
std::string rung_name(Rung rung);

/// Why a rung is not stood on, in words; empty where it is.
std::string refusal_in_words(const RungResult& rung);

/// Errors of every rung on held-out flight in m/s, rad/s and degrees, and which one is taken.
Section ladder_section(const LadderResult& ladder);

/// As `ladder` of a result: rungs with errors and constants, and the chosen one.
nlohmann::ordered_json as_json(const LadderResult& ladder);

}  // namespace ident
