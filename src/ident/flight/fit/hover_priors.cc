// Tight priors for the held constants, and their parameters as before the flight.
#include "ident/flight/fit/hover_priors.h"

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

constexpr double kHeld = 1e-3;  // of the standard deviation of the prior

bool needs_motion(int index) {
  switch (index) {
    case param::kQ:
    case param::omega_m:
    case param::zeta_m:
    case param::dead_time:
    case param::Omega_0:
    case param::Jp:
    case param::Jxx:
    case param::Jyy:
    case param::Jzz:
    case param::Jxy:
    case param::Jxz:
    case param::Jyz:
      return true;
    default:
      return false;
  }
}

}  // namespace

bool is_hover(std::span<const Warning> findings) {
  return std::ranges::find(findings, "hover_only", &Warning::code) != findings.end();
}

std::vector<std::string> hold_for_hover(std::vector<FreeConstant>& constants, Held which) {
  std::vector<std::string> held;
  for (FreeConstant& c : constants) {
    if (!needs_motion(c.index)) continue;
    held.push_back(c.name);
    if (which == Held::unstated && c.prior_std) continue;
    if (!c.prior_std) c.prior_value = c.start;
    c.prior_std = kHeld * c.prior_std.value_or(std::abs(c.unit()));
    know_alone(constants, c.index);
  }
  return held;
}

void as_before_flight(std::vector<Parameter>& parameters, const std::vector<FreeConstant>& constants,
                      std::span<const std::string> held) {
  for (Parameter& p : parameters) {
    if (std::ranges::find(held, p.name) == held.end()) continue;
    const auto before = std::ranges::find(constants, p.name, &FreeConstant::name);
    const double std = before->prior_std.value_or(std::abs(before->unit()));
    p.value = before->prior_std ? before->prior_value : before->start;
    p.std = std, p.naive_std = std;
    p.ci95 = {p.value - 1.96 * std, p.value + 1.96 * std};
    p.prior_std = before->prior_std, p.prior_value.reset(), p.pull.reset();
    if (before->prior_std) p.prior_value = before->prior_value;
    p.from_flight = 0.0;
    p.doubt({});
    p.note = "held at what was known: these logs hold little more than hover";
  }
}

}  // namespace ident
