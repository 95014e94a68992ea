// What a vehicle does between the ends of one step of order 2: rates lie on a parabola through those at its
// start, middle and end, and the state is its integral, which at the end is the step's own, by Simpson's
// rule.
#pragma once

#include "ident/model/flight.h"

namespace ident {

/// A step of h seconds from `x` on. What it refers to must outlive it.
template <class S>
class WithinStep {
 public:
  WithinStep(double h, const FlightState<S>& x, const BodyRate<S>& start, const StepMiddle<S>& middle,
             const FlightState<S>& x_end, const BodyRate<S>& end)
      : h_(h), x_(&x), start_(&start), middle_(&middle), x_end_(&x_end), end_(&end) {}

  /// At the share `u` of it.
  BodyState<S> body(double u) const {
    const double u2 = u * u, u3 = u2 * u;
    const double a = h_ * (u - 1.5 * u2 + 2 * u3 / 3), b = h_ * (2 * u2 - 4 * u3 / 3),
                 c = h_ * (2 * u3 / 3 - 0.5 * u2);
    const auto at = [&](const auto& from, auto rate) {
      return sum(sum(sum(from, a, start_->*rate), b, middle_->rate.*rate), c, end_->*rate);
    };
    const BodyState<S>& x = x_->body;
    return {at(x.q_WB, &BodyRate<S>::q_dot), at(x.w_B, &BodyRate<S>::w_dot_B),
            at(x.v_W, &BodyRate<S>::v_dot_W), at(x.x_W, &BodyRate<S>::x_dot_W)};
  }

  /// Turning acceleration and specific force; the other rates stay at zero.
  BodyRate<S> rate(double u) const {
    const double a = (1 - u) * (1 - 2 * u), b = 4 * u * (1 - u), c = u * (2 * u - 1);
    const auto at = [&](auto rate) {
      const Vec3<S> none(S(0.0), S(0.0), S(0.0));
      return sum(sum(sum(none, a, start_->*rate), b, middle_->rate.*rate), c, end_->*rate);
    };
    BodyRate<S> out;
    out.w_dot_B = at(&BodyRate<S>::w_dot_B), out.f_B = at(&BodyRate<S>::f_B);
    return out;
  }

  /// Speed of one rotor: a cubic through speeds and their rates at either end of its half of the step.
  S speed(double u, std::size_t rotor) const {
    const bool first = u < 0.5;
    const MotorState<S>&from = first ? x_->motors[rotor] : middle_->motors[rotor],
          &to = first ? middle_->motors[rotor] : x_end_->motors[rotor];
    const double s = first ? 2 * u : 2 * u - 1, h = h_ / 2;
    return sum(sum(sum(S((1 + 2 * s) * (1 - s) * (1 - s) * from.Omega), s * s * (3 - 2 * s), to.Omega),
                   h * s * (1 - s) * (1 - s), from.Omega_dot),
               h * s * s * (s - 1), to.Omega_dot);
  }

 private:
  double h_;
  const FlightState<S>* x_;
  const BodyRate<S>* start_;
  const StepMiddle<S>* middle_;
  const FlightState<S>* x_end_;
  const BodyRate<S>* end_;
};

}  // namespace ident
