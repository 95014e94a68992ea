// What an answer is worth against the truth, and the counts from which the tables are made.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "answers.h"

namespace withheld {

enum class Outcome { right, group, part, extra, wide, wrong, unknown, none, failed };
const char* name_of(Outcome outcome);

// right: exactly the truth is named. group: ambiguous, at most 3 causes, the truth among them. part: one
// member of a pair and nothing untrue. extra: the truth and something untrue. wide: ambiguous otherwise.
// wrong: identified without the truth.
Outcome outcome_of(const Truth& truth, const Answer& answer);

// For a truth that is not in the catalogue: any name is wrong.
Outcome outcome_without_truth(const Answer& answer);

// Size of a case over its detection limit: of a pair the smaller member's; 0 without effect.
double size_of(const Truth& truth);

struct SizeBin {
  double from, to;
  std::string label() const;
};
const std::vector<SizeBin>& size_bins();

struct Share {
  int hits = 0, of = 0;
  void count(bool hit) {
    hits += hit;
    ++of;
  }
  std::string text() const;  // "95 % (19/20)"
};

struct Reliability {
  int count = 0, truly = 0;
  double stated = 0;  // sum of probabilities
};
std::vector<Reliability> reliability(const std::vector<Scored>& cases);

// Parameters of rightly named effects within 2 of their standard deviations; `form` exact or near.
Share recovery(const std::vector<Scored>& cases, const std::string& form);

double median(std::vector<double> values);

}  // namespace withheld
