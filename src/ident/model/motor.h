// The motor with its speed controller: second order, solved exactly for a command that is held constant.
//
//   Omega'' + 2 zeta_m omega_m Omega' + omega_m^2 Omega = omega_m^2 (Omega_0 + km delta(t - dead_time))   (1)
//   [Phang 22]
//
// Departure from [Phang 22]: dead time, and an offset Omega_0 for real command curves (0 is the source's
// form). With target = Omega_0 + km delta constant over h, x = (Omega - target, Omega') obeys x' = A x, and
//
//   exp(A h) = exp(-zeta_m omega_m h) [ C(z) I + h S(z) (A + zeta_m omega_m I) ]                          (2)
//   z = omega_m^2 (zeta_m^2 - 1) h^2,  C(z) = cosh(sqrt z),  S(z) = sinh(sqrt z)/sqrt z
//
// C and S are entire functions of z, so (2) has finite derivatives through zeta_m = 1 and at h = 0.
#pragma once

#include <vector>

#include "ident/core/math.h"

namespace ident {

/// Rotor speed, rad/s, and its rate, rad/s^2.
template <class S>
struct MotorState {
  S Omega, Omega_dot;
};

/// exp(A h): carries the deviation from the target over a step.
template <class S>
struct MotorTransition {
  S p11, p12, p21, p22;

  MotorState<S> operator()(const MotorState<S>& x, const S& target) const {
    const S d = x.Omega - target;
    return {target + p11 * d + p12 * x.Omega_dot, p21 * d + p22 * x.Omega_dot};
  }

  /// The same for a target that moves on from `target` by `slope` over the h seconds of this transition;
  /// `lag` is 2 zeta_m/omega_m. Along target - lag slope the motor follows without a transient.
  MotorState<S> operator()(const MotorState<S>& x, const S& target, const S& slope, const S& lag,
                           double h) const {
    const S followed = target - lag * slope, d = x.Omega - followed, v = x.Omega_dot - slope;
    return {followed + h * slope + p11 * d + p12 * v, slope + p21 * d + p22 * v};
  }
};

/// Equation (2) for a step of h seconds; omega_m > 0, zeta_m > 0. No overflow for strong overdamping.
template <class S>
MotorTransition<S> motor_transition(const S& omega_m, const S& zeta_m, double h) {
  using std::cos, std::exp, std::sin, std::sqrt;
  const S sigma = zeta_m * omega_m;
  const S z = omega_m * omega_m * (zeta_m * zeta_m - 1.0) * (h * h);
  S C, D;  // exp(-sigma h) times C(z) and h S(z)
  if (value(z) > 0.25) {
    const S root = sqrt(zeta_m * zeta_m - 1.0);
    const S slow = exp(-(omega_m * h) / (zeta_m + root)), fast = exp(-(omega_m * h) * (zeta_m + root));
    C = 0.5 * (slow + fast);
    D = 0.5 * (slow - fast) / (omega_m * root);
  } else if (value(z) < -0.25) {
    const S omega_d = omega_m * sqrt(1.0 - zeta_m * zeta_m), decay = exp(-sigma * h);
    C = decay * cos(omega_d * h);
    D = decay * sin(omega_d * h) / omega_d;
  } else {
    S even(1.0), odd(1.0), even_term(1.0), odd_term(1.0);
    for (int k = 1; k <= 8; ++k) {
      even_term = even_term * z * (1.0 / ((2 * k - 1) * (2 * k)));
      odd_term = odd_term * z * (1.0 / ((2 * k) * (2 * k + 1)));
      even = even + even_term;
      odd = odd + odd_term;
    }
    const S decay = exp(-sigma * h);
    C = decay * even;
    D = decay * odd * h;
  }
  return {C + sigma * D, D, -(omega_m * omega_m) * D, C - sigma * D};  // (2)
}

/// Last row with t <= at, the first row if there is none; n > 0. Quick where rows are about evenly spaced.
/// Templated on the scalar so that code compiled for one instruction set never calls that of another
/// (core/dual.h).
template <class S>
std::size_t row_before(const double* t, std::size_t n, double at) {
  if (n < 2 || !(at >= t[1])) return 0;
  if (at >= t[n - 1]) return n - 1;
  std::size_t low = static_cast<std::size_t>((at - t[0]) / (t[n - 1] - t[0]) * static_cast<double>(n - 1));
  if (low > n - 2) low = n - 2;
  std::size_t high = low + 1, stride = 1;
  while (t[low] > at) high = low, low = low > stride ? low - stride : 0, stride *= 2;
  while (t[high] <= at) low = high, high = high + stride < n - 1 ? high + stride : n - 1, stride *= 2;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (t[middle] <= at ? low : high) = middle;
  }
  return low;
}

/// A command over a step: the straight line with the same mean and the same first moment.
template <class S>
struct CommandLine {
  S mean, slope;      ///< the slope only of a bent one
  bool bent = false;  ///< the command changes within the step
};

/// A command history held from each sample to the next; answers the line that stands for it over an interval.
///
/// A jump by D at c seconds after the start of a step of h seconds adds D (h - c)/h to the mean and
/// 6 D c (h - c)/h^3 to the slope. Both are continuous in the dead time tau and have a derivative, where a
/// sampled command would have none; a mean alone would put jumps off the rows in the wrong place by up to
/// h/8.
class HeldCommand {
 public:
  HeldCommand() = default;
  /// `t` strictly increasing, `delta` of the same length; held before the first and after the last.
  HeldCommand(const std::vector<double>& t, const std::vector<double>& delta) {
    for (std::size_t i = 0; i < t.size(); ++i) append(t[i], delta[i]);
  }

  /// One more sample, later than all before.
  void append(double t, double delta) { t_.push_back(t), delta_.push_back(delta); }

  /// Over [from - tau, to - tau]. `Delay` is the scalar S, or double for a delay that is not estimated; S
  /// says which build of the code this is. A jump on the edge between two steps belongs to the later one: any
  /// delay moves it there, so that this is where its derivative is.
  template <class S, class Delay>
  CommandLine<Delay> line(double from, double to, const Delay& tau) const {
    constexpr double edge = 1e-9;  // s, beyond any rounding of times
    constexpr bool estimated = !std::is_same_v<Delay, double>;
    const double h = to - from, *t = t_.data(), *delta = delta_.data();
    const double begin = from - value(tau) + (estimated ? -edge : edge), end = to - value(tau) - edge;
    std::size_t i = row_before<S>(t, t_.size(), begin);
    CommandLine<Delay> line{Delay(delta[i]), Delay(0.0)};
    for (++i; i < t_.size() && t[i] < end; ++i) {
      if (t[i] <= begin) continue;  // before the first row its value holds
      Delay c = tau + (t[i] - from);
      if (value(c) < 0) c = c - value(c);
      const Delay left = h - c;
      const double jump = delta[i] - delta[i - 1];
      line.mean = line.mean + (jump / h) * left;
      line.slope = line.slope + (6 * jump / (h * h * h)) * (c * left);
      line.bent = true;
    }
    return line;
  }

  /// Value that holds at time `at`.
  template <class S>
  double at(const S& at) const {
    return delta_.data()[row_before<S>(t_.data(), t_.size(), value(at))];
  }

 private:
  std::vector<double> t_, delta_;
};

}  // namespace ident
