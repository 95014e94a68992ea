// Do the rotors as mounted explain how the vehicle turns? Every other order of the rotors, and every reversed
// axis, is tried against the order as stated.
#include "ident/flight/checks/rotor_order.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "ident/core/parallel.h"
#include "ident/flight/checks/rotor_windows.h"

namespace ident {
namespace {

constexpr double kClear = 0.3;         ///< r^2 that another order must reach about an axis
constexpr double kHalf = 0.5;          ///< of what the other explains: the stated one may reach no more
constexpr double kFewWindows = 60;     ///< too few to judge
constexpr std::size_t kLookedAt = 24;  ///< orders whose correlations are clipped

struct Hypothesis {
  RotorOrder order;
  std::array<double, 3> sign{1, 1, 1};
  std::array<double, 3> r{};  ///< correlation about each axis with this order, before the signs
  int quarters = 0;           ///< turns of the sensors about the vehicle's z axis

  double agreement(std::size_t k) const { return sign[k] * r[k] * std::abs(r[k]); }
  double total() const { return agreement(0) + agreement(1) + agreement(2); }
};

std::vector<RotorOrder> all_orders(std::size_t rotors) {
  RotorOrder order(rotors);
  std::iota(order.begin(), order.end(), 0);
  std::vector<RotorOrder> out{order};
  while (std::next_permutation(order.begin(), order.end())) out.push_back(order);
  return out;
}

/// What the correlation of any order needs, before anything is clipped.
class Covariances {
 public:
  explicit Covariances(const RotorWindows& windows) {
    const auto columns = static_cast<Eigen::Index>(windows.thrust.size());
    Eigen::MatrixXd X(static_cast<Eigen::Index>(windows.count()), 2 * columns);
    Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(X.rows(), 3);
    const auto as_vector = [&](const Track& x) {
      return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
    };
    for (Eigen::Index n = 0; n < columns; ++n) {
      X.col(n) = as_vector(windows.thrust[static_cast<std::size_t>(n)]);
      X.col(columns + n) = as_vector(windows.spin[static_cast<std::size_t>(n)]);
    }
    for (std::size_t k = 0; k < 3; ++k)  // empty where nothing moves
      if (!windows.rates[k].empty()) rates.col(static_cast<Eigen::Index>(k)) = as_vector(windows.rates[k]);
    X.rowwise() -= X.colwise().mean();
    own_ = X.transpose() * X, with_rates_ = X.transpose() * rates;
  }

  /// Sum of the signed squares of the correlations about the three axes.
  double agreement(const std::vector<RotorMoment>& rotors, const RotorOrder& order) const {
    const Eigen::Index columns = own_.rows() / 2;
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(2 * columns, 3);
    for (std::size_t n = 0; n < order.size(); ++n) {
      const auto column = static_cast<Eigen::Index>(order[n]);
      weight.row(column) = rotors[n].by_thrust, weight.row(columns + column) = rotors[n].by_spin;
    }
    double sum = 0;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double along = weight.col(k).dot(with_rates_.col(k));
      sum += along * std::abs(along) / std::max(weight.col(k).dot(own_ * weight.col(k)), 1e-300);
    }
    return sum;
  }

 private:
  Eigen::MatrixXd own_, with_rates_;
};

/// The stated order, and those others that are worth a closer look: of more than four rotors there are many.
std::vector<RotorOrder> orders(const RotorWindows& windows, const std::vector<RotorMoment>& rotors) {
  std::vector<RotorOrder> all = all_orders(rotors.size());
  if (all.size() <= kLookedAt) return all;
  const Covariances covariances(windows);
  std::vector<std::pair<double, std::size_t>> by_agreement;
  for (std::size_t i = 1; i < all.size(); ++i)
    by_agreement.emplace_back(-covariances.agreement(rotors, all[i]), i);
  std::ranges::partial_sort(by_agreement, by_agreement.begin() + kLookedAt);
  std::vector<RotorOrder> out{all[0]};
  for (std::size_t i = 0; i < kLookedAt; ++i) out.push_back(all[by_agreement[i].second]);
  return out;
}

/// Explains so much about every axis that no other could be clearly better.
bool plainly_right(const Hypothesis& h) {
  return std::min({h.agreement(0), h.agreement(1), h.agreement(2)}) >= kHalf;
}

/// The stated order first, then that with reversed and with turned axes, then `others`.
std::vector<Hypothesis> hypotheses(const RotorWindows& windows, const std::vector<RotorMoment>& rotors,
                                   bool others) {
  RotorOrder as_stated(rotors.size());
  std::iota(as_stated.begin(), as_stated.end(), 0);
  std::vector<Hypothesis> out;
  for (const RotorOrder& order : others ? orders(windows, rotors) : std::vector<RotorOrder>{as_stated}) {
    const bool stated = out.empty();
    const Eigen::Matrix3d r = correlation_of(windows, rotors, order);
    Hypothesis h{.order = order, .r = {r(0, 0), r(1, 1), r(2, 2)}};
    for (unsigned reversed = 0; reversed < (stated ? 8u : 1u); ++reversed) {
      for (std::size_t k = 0; k < 3; ++k) h.sign[k] = (reversed >> k & 1) ? -1.0 : 1.0;
      out.push_back(h);
    }
    if (!stated) continue;
    out.push_back({.order = order, .r = {r(0, 1), -r(1, 0), r(2, 2)}, .quarters = 1});
    out.push_back({.order = order, .r = {-r(0, 1), r(1, 0), r(2, 2)}, .quarters = 3});
  }
  return out;
}

/// Does `other` explain at least one axis clearly, that the stated order does not, and lose none?
bool clearly_better(const Hypothesis& other, const Hypothesis& stated) {
  int clear = 0, gained = 0;
  double top = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = other.agreement(k), b = stated.agreement(k);
    if (a < 0.7 * b || a < -0.1) return false;
    clear += a > kClear, gained += a > kClear && b < kHalf * a;
    if (b < kHalf * a) top = std::max(top, a);
  }
  return gained > 0 && (clear > 1 || top > 0.6) && other.total() > stated.total() + kClear;
}

bool turns_yaw_alone(const Hypothesis& h) { return h.sign[0] > 0 && h.sign[1] > 0 && h.sign[2] < 0; }

std::string in_words(const Hypothesis& h, bool rates_confirmed) {
  constexpr std::array names = {"p", "q", "r"};
  constexpr const char* kSpins = "every rotor spinning the other way round";
  if (h.quarters == 1) return "axes turned by a quarter, p read from -q and q from p";
  if (h.quarters == 3) return "axes turned by a quarter, p read from q and q from -p";
  std::vector<std::string> reversed;
  for (std::size_t k = 0; k < 3; ++k)
    if (h.sign[k] < 0) reversed.emplace_back(names[k]);
  if (rates_confirmed && !reversed.empty()) return kSpins;
  if (!reversed.empty())
    return fmt::format("{} with the sign reversed{}", fmt::join(reversed, ", "),
                       turns_yaw_alone(h) ? fmt::format(", or as well by {}", kSpins) : "");
  std::vector<std::size_t> from_one = h.order;
  for (std::size_t& n : from_one) ++n;
  return fmt::format("rotor order {}", fmt::join(from_one, " "));
}

/// The hypotheses over windows of one lag, the rates shifted by a share of the margin.
struct Trial {
  std::vector<Hypothesis> all;  ///< none: too few windows to judge
  double most = -1;             ///< agreement of the best
  double windows = 0, thrust_variation = 0;
  YawShares yaw;  ///< in the stated order
};
struct Mended {
  const char *code, *advice;
};
Mended mended(const Hypothesis& h, bool rates_confirmed) {
  if (h.quarters != 0) return {"axes_swapped", "read rates and specific force so in a map file"};
  if (std::ranges::count(h.sign, -1.0) == 0)
    return {"motor_order", "list, for rotor 1, 2, ... of the vehicle file, the columns in that order"};
  if (rates_confirmed) return {"rotor_spin", "exchange cw and ccw in the vehicle file"};
  return {"sign_flipped", "correct the sign in a map file"};
}

std::optional<Warning> finding(const Trial& trial, bool rates_confirmed, const char* source) {
  const std::vector<Hypothesis>& all = trial.all;
  const bool yaw_runs_backwards =
      trial.yaw.reversed > kClear && trial.yaw.as_stated < kHalf * trial.yaw.reversed;
  const auto reversals = [](const Hypothesis& h) { return std::ranges::count(h.sign, -1.0); };
  std::vector<Hypothesis> better;
  for (const Hypothesis& h : all) {
    // Where the rates are right what seems reversed is the vehicle: about yaw by the spin of its rotors,
    // about the other axes by their order.
    const bool ruled_out = turns_yaw_alone(h) ? !yaw_runs_backwards : rates_confirmed && reversals(h) > 0;
    if (!ruled_out && clearly_better(h, all[0])) better.push_back(h);
  }
  if (better.empty()) return std::nullopt;
  std::ranges::stable_sort(better, std::greater(), &Hypothesis::total);
  std::erase_if(better, [&](const Hypothesis& h) { return h.total() < better[0].total() - 0.06; });
  // One reversed sensor axis, or sensors that are turned, is a simpler mistake than a wrong order; two at
  // once are not, and neither are sensors that the attitude confirms.
  std::ranges::stable_sort(better, {}, [&](const Hypothesis& h) {
    if (h.quarters != 0) return rates_confirmed ? 2 : 0;
    return reversals(h) == 1 ? 0 : reversals(h) == 0 ? 1 : 2;
  });
  std::string words = in_words(better[0], rates_confirmed);
  for (std::size_t i = 1; i < better.size() && i < 3; ++i)
    words += ", or as well by " + in_words(better[i], rates_confirmed);
  const auto [code, advice] = mended(better[0], rates_confirmed);
  return Warning{
      code, fmt::format("the {} do not explain how this vehicle turns as its rotors are stated; they do by "
                        "{} (shared variance about roll, pitch, yaw {:.2f}, {:.2f}, {:.2f} instead of "
                        "{:.2f}, {:.2f}, {:.2f}): {}",
                        source, words, better[0].agreement(0), better[0].agreement(1), better[0].agreement(2),
                        all[0].agreement(0), all[0].agreement(1), all[0].agreement(2), advice)};
}

constexpr std::array kLags = {0.04, 0.15};
constexpr std::array kShifts = {0.0, -0.5, 0.5, 1.0};
constexpr std::size_t kTrials = kLags.size() * kShifts.size();

Trial trial(const std::vector<Streams>& arcs, double interval, const std::vector<RotorMoment>& rotors,
            std::size_t number, bool others) {
  const double lag = kLags[number / kShifts.size()];
  const RotorWindows windows = rotor_windows(arcs, interval, lag, kShifts[number % kShifts.size()]);
  Trial out;
  out.windows = static_cast<double>(windows.count());
  if (out.windows < kFewWindows) return out;
  out.all = hypotheses(windows, rotors, others);
  out.most = std::ranges::max(out.all, {}, &Hypothesis::total).total();
  out.thrust_variation = thrust_variation(windows, arcs, lag);
  out.yaw = yaw_shares(windows, rotors, out.all[0].order);
  return out;
}

/// The best of all trials. Other orders of the rotors are tried where the stated one is plainly right in
/// none.
Trial best_trial(const std::vector<Streams>& arcs, double interval, const std::vector<RotorMoment>& rotors) {
  std::array<Trial, kTrials> trials;
  for (const bool others : {false, true}) {
    in_parallel(trials.size(), [&](std::size_t i) { trials[i] = trial(arcs, interval, rotors, i, others); });
    if (std::ranges::any_of(trials, [](const Trial& t) { return !t.all.empty() && plainly_right(t.all[0]); }))
      break;
  }
  return *std::ranges::max_element(trials, {}, &Trial::most);
}

}  // namespace

RotorTest test_rotors(const FlightRecord& record, const Vehicle& vehicle, std::span<const double> p) {
  std::array<Trial, 2> best;  // of commands, and of measured speeds
  const Signals& s = record.signals;
  if (s.rates || s.attitude)
    in_parallel(best.size(), [&](std::size_t measured) {
      if (measured ? !s.rotor_speeds : !s.commands) return;
      std::vector<Streams> arcs;
      for (const FlightArc& arc : record.arcs) arcs.push_back(rotor_streams(arc, vehicle, p, measured != 0));
      best[measured] = best_trial(arcs, record.interval, rotor_moments(vehicle, p));
    });
  return [best = std::move(best)](bool rates_confirmed) {
    RotorAgreement out;
    for (std::size_t measured = 0; measured < best.size(); ++measured) {
      const Trial& one = best[measured];
      if (one.all.empty()) continue;
      out.correlation = one.all[0].r, out.windows = one.windows;
      out.thrust_variation = one.thrust_variation;
      if (const auto found = finding(one, rates_confirmed, measured ? "rotor speeds" : "commands"))
        out.findings.push_back(*found);
    }
    return out;
  };
}

}  // namespace ident
