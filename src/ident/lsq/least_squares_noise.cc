// Level and colour of the noise, found one constant at a time.
#include "ident/lsq/least_squares_noise.h"

#include <algorithm>
#include <cmath>

#include "ident/lsq/least_squares_likelihood.h"

namespace ident {
namespace {

constexpr double kRowsPerOrder = 12.0;  // beyond what the unknowns take of the group

/// Smallest value of f between low and high, by golden section and parabolas [Brent 1973].
template <typename Function>
double minimum(const Function& f, double low, double high, double start, double tolerance) {
  constexpr double golden = 0.3819660112501051;
  double x = start, w = start, v = start, fx = f(start), fw = fx, fv = fx, step = 0.0, last = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if (std::fabs(x - middle) <= 2.0 * tolerance - 0.5 * (high - low)) break;
    bool parabola = false;
    if (std::fabs(last) > tolerance) {
      const double r = (x - w) * (fx - fv), q = (x - v) * (fx - fw);
      const double p = (x - v) * q - (x - w) * r, d = 2.0 * (q - r);
      const double move = d != 0.0 ? -p / d : 0.0;
      if (d != 0.0 && std::fabs(move) < 0.5 * std::fabs(last) && x + move > low && x + move < high) {
        last = step;
        step = move;
        parabola = true;
      }
    }
    if (!parabola) {
      last = (x < middle ? high : low) - x;
      step = golden * last;
    }
    const double u = x + (std::fabs(step) >= tolerance ? step : std::copysign(tolerance, step));
    const double fu = f(u);
    if (fu <= fx) {
      (u < x ? high : low) = x;
      v = w, fv = fw, w = x, fw = fx, x = u, fx = fu;
    } else {
      (u < x ? low : high) = u;
      if (fu <= fw || w == x)
        v = w, fv = fw, w = u, fw = fu;
      else if (fu <= fv || v == x || v == w)
        v = u, fv = fu;
    }
  }
  return x;
}

/// Minimum near the start, and over the whole range where it does not lie there.
template <typename Function>
double nearby_minimum(const Function& f, double start, double largest, double tolerance) {
  constexpr double reach = 0.6;
  const double low = std::max(start - reach, -largest), high = std::min(start + reach, largest);
  const double found = minimum(f, low, high, start, tolerance);
  const bool inside = found - low > 0.05 * reach && high - found > 0.05 * reach;
  return inside ? found : minimum(f, -largest, largest, found, tolerance);
}

/// Level and colour of the given order, one partial autocorrelation after the other.
void fit_colour(RestrictedLikelihood& likelihood, std::size_t g, Eigen::VectorXd partial) {
  // A twentieth of what the data can tell of them.
  const double largest = largest_atanh(likelihood.rows(g));
  const double tolerance = std::clamp(0.05 / std::sqrt(likelihood.rows(g)), 2e-4, 5e-3);
  for (int round = 0; round < 6; ++round) {
    const Eigen::VectorXd before = partial;
    for (Eigen::Index k = 0; k < partial.size(); ++k) {
      const auto cost = [&](double z) {
        partial(k) = std::tanh(z);
        likelihood.set_colour(g, Colour(partial));
        likelihood.fit_level(g);
        return likelihood.minus_two_log() + minus_two_log_prior(partial);
      };
      cost(nearby_minimum(cost, std::clamp(std::atanh(partial(k)), -largest, largest), largest, tolerance));
    }
    if (partial.size() < 2 || (partial - before).cwiseAbs().maxCoeff() < 2.0 * tolerance) break;
  }
}

void fit_group(RestrictedLikelihood& likelihood, std::size_t g, int max_order) {
  const double n = likelihood.rows(g);
  GroupNoise best = likelihood.noise()[g];
  double best_criterion = 0.0;
  Eigen::VectorXd partial(0);
  for (int order = 0; order <= max_order; ++order) {
    if (order > 0) {
      const Eigen::VectorXd shorter = partial;
      partial.resize(order);
      partial << shorter, 0.0;
    }
    likelihood.set_colour(g, Colour(partial));
    likelihood.fit_level(g);
    if (order > 0) fit_colour(likelihood, g, partial);
    partial = likelihood.noise()[g].colour.partial();
    const double criterion = likelihood.minus_two_log() + order * std::log(std::max(n, 2.0));
    if (order == 0 || criterion < best_criterion) {
      best = likelihood.noise()[g];
      best_criterion = criterion;
    } else if (order > best.colour.order() + 1) {
      break;
    }
  }
  likelihood.set_colour(g, best.colour);
  likelihood.set_level(g, best.sigma);
}

}  // namespace

double whiten(const std::vector<ResidualSeries>& series, const std::vector<GroupNoise>& noise,
              const std::vector<bool>& missing, Eigen::MatrixXd& rows) {
  double log_variances = 0.0;
  for (const ResidualSeries& s : series) {
    const GroupNoise& group = noise[static_cast<std::size_t>(s.group)];
    log_variances += group.colour.whiten(s.begin, s.end, missing, rows);
    rows.middleRows(s.begin, s.end - s.begin) /= group.sigma;
    log_variances +=
        2.0 * std::log(group.sigma) *
        static_cast<double>(std::count(missing.begin() + s.begin, missing.begin() + s.end, false));
  }
  return log_variances;
}

std::vector<GroupNoise> estimate_noise(const LeastSquaresProblem& problem, const NoiseSearch& search,
                                       const LinearisedRows& rows, std::vector<GroupNoise> noise) {
  RestrictedLikelihood likelihood(problem, rows, std::move(noise), search.max_colour_order);
  const int rounds = problem.groups.size() == 1 ? 1 : 4;
  double before = likelihood.minus_two_log();
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t g = 0; g < problem.groups.size(); ++g) {
      if (!likelihood.level_is_free(g)) continue;
      const int most =
          problem.groups[g].in_time_order
              ? std::min(search.max_colour_order, static_cast<int>(likelihood.freedom(g) / kRowsPerOrder))
              : 0;
      if (round == 0 && search.order_is_free)
        fit_group(likelihood, g, most);
      else
        fit_colour(likelihood, g, likelihood.noise()[g].colour.partial());
      likelihood.fit_level(g);
    }
    const double now = likelihood.minus_two_log();
    if (std::fabs(now - before) < 1e-3) break;
    before = now;
  }
  return likelihood.noise();
}

}  // namespace ident
