// The tables of field_score, one function each.
#pragma once

#include "case.h"

namespace field {

void print_prediction(const std::vector<ScoredCase>& cases, bool details);
void print_coverage(const std::vector<ScoredCase>& cases, bool details);
void print_diagnosis(const std::vector<ScoredCase>& cases, bool details);
void print_seconds(const std::vector<ScoredCase>& cases);

}  // namespace field
