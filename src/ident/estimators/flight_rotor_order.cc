// Do the rotors as mounted explain how the vehicle turns? Every other order of the rotors, and every reversed
// axis, is tried against the order as stated.
//
// Over a window the change of the rates is J^-1 times the integral of the moment
//   sum_n (r_n x kT a_n - s_n kQ a_n) Omega_n^2 - sigma s_n Jp a_n Omega_n'                    [flight model
//   (4)]
// whose scale does not matter to a correlation, only its pattern over the rotors.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "ident/core/parallel.h"
#include "ident/estimators/flight_changes.h"
#include "ident/estimators/flight_self_test.h"
#include "ident/estimators/statistics.h"
#include "ident/model/flight.h"

namespace ident {
namespace {

constexpr double kClear = 0.3;            ///< r^2 that another order must reach about an axis
constexpr double kHalf = 0.5;             ///< of what the other explains: the stated one may reach no more
constexpr double kFewWindows = 60;        ///< too few to judge
constexpr std::size_t kMostPermuted = 4;  ///< rotors; above, pairs only

using Order = std::vector<std::size_t>;  ///< column that drives each rotor

struct Hypothesis {
  Order order;
  std::array<double, 3> sign{1, 1, 1};
  std::array<double, 3> r{};  ///< correlation about each axis with this order, before the signs

  double agreement(std::size_t k) const { return sign[k] * r[k] * std::abs(r[k]); }
  double total() const { return agreement(0) + agreement(1) + agreement(2); }
};

/// Changes of the rates, clipped, and of the integral of Omega^2 and of Omega of each column.
struct Windows {
  Track3 rates;
  std::vector<Track> thrust, spin;
  std::size_t count() const { return thrust[0].size(); }
};

/// Rotor speeds as measured or, when those are not asked for or not there, simulated from the commands.
std::vector<Track> rotor_speeds(const FlightArc& arc, const Vehicle& vehicle, std::span<const double> p,
                                bool measured) {
  const std::size_t rotors = vehicle.rotors.size();
  std::vector<Track> out(rotors, Track(arc.rows(), 0.0));
  if (measured) {
    for (std::size_t n = 0; n < rotors && n < arc.inputs->Omega.size(); ++n)
      if (arc.inputs->Omega[n].size() == arc.rows()) out[n] = arc.inputs->Omega[n];
    return out;
  }
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(vehicle, p, effects, *arc.inputs);
  std::array<MotorState<double>, kMaxRotors> motors{};
  for (std::size_t n = 0; n < rotors; ++n) motors[n] = {flight.steady_speed(n, arc.t[0]), 0.0};
  for (std::size_t i = 0; i < arc.rows(); ++i) {
    for (std::size_t n = 0; n < rotors; ++n) out[n][i] = motors[n].Omega;
    if (i + 1 < arc.rows()) flight.advance(motors, arc.t[i], arc.t[i + 1] - arc.t[i]);
  }
  return out;
}

/// What is compared of an arc.
struct Streams {
  std::array<RunningSum, 3> rates;
  std::vector<RunningSum> thrust, spin;  ///< integral of Omega^2, Omega of each column
  std::vector<double> mean_square;       ///< of Omega of each column
};

Streams streams_of(const FlightArc& arc, const std::vector<Track>& speeds) {
  Streams out;
  Track rate(arc.rows());
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < arc.rows(); ++i)
      rate[i] = arc.start[i].body.w_B[static_cast<Eigen::Index>(k)];
    out.rates[k] = rate;
  }
  for (const Track& speed : speeds) {
    Track square = speed;
    for (double& v : square) v *= v;
    out.thrust.emplace_back(integral(arc.t, square)), out.spin.emplace_back(speed);
    out.mean_square.push_back(std::pow(root_mean_square(speed), 2));
  }
  return out;
}

Windows windows_at(const std::vector<Streams>& arcs, double interval, double lag, double shift) {
  const ChangeWindows windows = change_windows(lag, interval);
  const long rows = std::lround(shift * static_cast<double>(windows.margin));
  const std::size_t columns = arcs[0].thrust.size();
  Windows out;
  Track3 rates;
  out.thrust.resize(columns), out.spin.resize(columns);
  for (const Streams& arc : arcs) {
    const auto& w = arc.rates;
    append(rates, {changes(w[0], windows), changes(w[1], windows), changes(w[2], windows)});
    for (std::size_t n = 0; n < columns; ++n) {
      const Track thrust = changes(arc.thrust[n], windows, rows), spin = changes(arc.spin[n], windows, rows);
      out.thrust[n].insert(out.thrust[n].end(), thrust.begin(), thrust.end());
      out.spin[n].insert(out.spin[n].end(), spin.begin(), spin.end());
    }
  }
  for (std::size_t k = 0; k < 3; ++k) out.rates[k] = clipped_unit(std::move(rates[k]));
  return out;
}

std::array<double, 3> correlation_of(const Windows& windows, const Vehicle& vehicle,
                                     std::span<const double> p, const Order& order) {
  const std::size_t count = windows.count();
  const double sigma = vehicle.signs == Signs::first_principles ? 1.0 : -1.0;
  Track3 moment{Track(count, 0.0), Track(count, 0.0), Track(count, 0.0)};
  for (std::size_t n = 0; n < order.size(); ++n) {
    const Rotor& rotor = vehicle.rotors[n];
    const Eigen::Vector3d a = axis_at(rotor, p[param::alpha]);
    const Eigen::Vector3d by_thrust =
        p[param::kT] * cross<double, double>(rotor.r_B, a) - rotor.s * p[param::kQ] * a;
    const Eigen::Vector3d by_spin = -sigma * rotor.s * p[param::Jp] * a;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < count; ++i)
        moment[k][i] += by_thrust[static_cast<Eigen::Index>(k)] * windows.thrust[order[n]][i] +
                        by_spin[static_cast<Eigen::Index>(k)] * windows.spin[order[n]][i];
  }
  std::array<double, 3> r{};
  for (std::size_t k = 0; k < 3; ++k)
    r[k] = correlation(windows.rates[k], clipped_unit(std::move(moment[k])));
  return r;
}

/// Spread of the whole thrust between windows over its mean.
double thrust_variation(const Windows& windows, const std::vector<Streams>& arcs, double lag) {
  Track sum(windows.count(), 0.0), mean_square;
  for (const Track& one : windows.thrust)
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += one[i];
  for (const Streams& arc : arcs)
    mean_square.insert(mean_square.end(), arc.mean_square.begin(), arc.mean_square.end());
  return mad_scale(sum) / (lag * static_cast<double>(windows.thrust.size()) * mean(mean_square));
}

std::vector<Order> orders(std::size_t rotors) {
  Order order(rotors);
  std::iota(order.begin(), order.end(), 0);
  std::vector<Order> out{order};
  if (rotors <= kMostPermuted) {
    while (std::next_permutation(order.begin(), order.end())) out.push_back(order);
    return out;
  }
  for (std::size_t a = 0; a < rotors; ++a)
    for (std::size_t b = a + 1; b < rotors; ++b) {
      out.push_back(out[0]);
      std::swap(out.back()[a], out.back()[b]);
    }
  return out;
}

/// Explains so much about every axis that no other could be clearly better.
bool plainly_right(const Hypothesis& h) {
  return std::min({h.agreement(0), h.agreement(1), h.agreement(2)}) >= kHalf;
}

/// The stated order first, then that with reversed axes, then `others`.
std::vector<Hypothesis> hypotheses(const Windows& windows, const Vehicle& vehicle, std::span<const double> p,
                                   bool others) {
  std::vector<Hypothesis> out;
  for (const Order& order : orders(vehicle.rotors.size())) {
    const bool stated = out.empty();
    if (!stated && !others) break;
    Hypothesis h{order, {1, 1, 1}, correlation_of(windows, vehicle, p, order)};
    for (unsigned reversed = 0; reversed < (stated ? 8u : 1u); ++reversed) {
      for (std::size_t k = 0; k < 3; ++k) h.sign[k] = (reversed >> k & 1) ? -1.0 : 1.0;
      out.push_back(h);
    }
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

std::string in_words(const Hypothesis& h) {
  constexpr std::array names = {"p", "q", "r"};
  std::vector<std::string> reversed;
  for (std::size_t k = 0; k < 3; ++k)
    if (h.sign[k] < 0) reversed.emplace_back(names[k]);
  if (!reversed.empty()) return fmt::format("{} with the sign reversed", fmt::join(reversed, ", "));
  std::vector<std::size_t> from_one = h.order;
  for (std::size_t& n : from_one) ++n;
  return fmt::format("rotor order {}", fmt::join(from_one, " "));
}

std::optional<Warning> finding(const std::vector<Hypothesis>& all, bool rates_confirmed, const char* source) {
  std::vector<Hypothesis> better;
  for (const Hypothesis& h : all) {
    const bool reverses = h.total() != 0 && (h.sign[0] < 0 || h.sign[1] < 0 || h.sign[2] < 0);
    if (!(reverses && rates_confirmed) && clearly_better(h, all[0])) better.push_back(h);
  }
  if (better.empty()) return std::nullopt;
  std::ranges::stable_sort(better, std::greater(), &Hypothesis::total);
  std::erase_if(better, [&](const Hypothesis& h) { return h.total() < better[0].total() - 0.06; });
  const auto reversals = [](const Hypothesis& h) { return std::ranges::count(h.sign, -1.0); };
  // One reversed sensor axis is a simpler mistake than a wrong order; two at once are not.
  std::ranges::stable_sort(better, {}, [&](const Hypothesis& h) {
    return reversals(h) == 1 ? 0 : reversals(h) == 0 ? 1 : 2;
  });
  std::string words = in_words(better[0]);
  for (std::size_t i = 1; i < better.size() && i < 3; ++i) words += ", or as well by " + in_words(better[i]);
  const bool order = reversals(better[0]) == 0;
  return Warning{
      order ? "motor_order" : "sign_flipped",
      fmt::format("the {} do not explain how this vehicle turns as its rotors are stated; they do by "
                  "{} (shared variance about roll, pitch, yaw {:.2f}, {:.2f}, {:.2f} instead of "
                  "{:.2f}, {:.2f}, {:.2f}): {}",
                  source, words, better[0].agreement(0), better[0].agreement(1), better[0].agreement(2),
                  all[0].agreement(0), all[0].agreement(1), all[0].agreement(2),
                  order ? "list, for rotor 1, 2, ... of the vehicle file, the columns in that order"
                        : "correct the sign in a map file")};
}

/// The hypotheses over windows of one lag, the rates shifted by a share of the margin.
struct Trial {
  std::vector<Hypothesis> all;  ///< none: too few windows to judge
  double most = -1;             ///< agreement of the best
  double windows = 0, thrust_variation = 0;
};
constexpr std::array kLags = {0.04, 0.15};
constexpr std::array kShifts = {0.0, -0.5, 0.5, 1.0};
constexpr std::size_t kTrials = kLags.size() * kShifts.size();

Trial trial(const std::vector<Streams>& arcs, double interval, const Vehicle& vehicle,
            std::span<const double> p, std::size_t number, bool others) {
  const double lag = kLags[number / kShifts.size()];
  const Windows windows = windows_at(arcs, interval, lag, kShifts[number % kShifts.size()]);
  Trial out;
  out.windows = static_cast<double>(windows.count());
  if (out.windows < kFewWindows) return out;
  out.all = hypotheses(windows, vehicle, p, others);
  out.most = std::ranges::max(out.all, {}, &Hypothesis::total).total();
  out.thrust_variation = thrust_variation(windows, arcs, lag);
  return out;
}

/// The best of all trials. Other orders of the rotors are tried where the stated one is plainly right in
/// none.
Trial best_trial(const std::vector<Streams>& arcs, double interval, const Vehicle& vehicle,
                 std::span<const double> p) {
  std::array<Trial, kTrials> trials;
  for (const bool others : {false, true}) {
    in_parallel(trials.size(),
                [&](std::size_t i) { trials[i] = trial(arcs, interval, vehicle, p, i, others); });
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
      for (const FlightArc& arc : record.arcs)
        arcs.push_back(streams_of(arc, rotor_speeds(arc, vehicle, p, measured != 0)));
      best[measured] = best_trial(arcs, record.interval, vehicle, p);
    });
  return [best = std::move(best)](bool rates_confirmed) {
    RotorAgreement out;
    for (std::size_t measured = 0; measured < best.size(); ++measured) {
      const Trial& one = best[measured];
      if (one.all.empty()) continue;
      out.correlation = one.all[0].r, out.windows = one.windows;
      out.thrust_variation = one.thrust_variation;
      if (const auto found = finding(one.all, rates_confirmed, measured ? "rotor speeds" : "commands"))
        out.findings.push_back(*found);
    }
    return out;
  };
}

}  // namespace ident
