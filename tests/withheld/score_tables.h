// The tables of a scored campaign, in Markdown.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "answers.h"

namespace withheld {

struct Contestant {
  std::string label;  // folder of its answers
  std::vector<Scored> cases;
};

// What was asked for, beside what each contestant reached.
void print_summary(const std::vector<Contestant>& contestants, std::ostream& out);

void print_by_size(const Contestant& contestant, std::ostream& out);
void print_confusion(const Contestant& contestant, std::ostream& out);
void print_substitutes(const Contestant& contestant, std::ostream& out);
void print_reliability(const Contestant& contestant, std::ostream& out);
void print_limits(const Contestant& contestant, std::ostream& out);

}  // namespace withheld
