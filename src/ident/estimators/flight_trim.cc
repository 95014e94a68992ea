// Balance of stretches of flight, its scatter, and its fit.
#include "ident/estimators/flight_trim.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/estimators/flight_channels.h"
#include "ident/estimators/flight_refine.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShortest = 2.0;    // s of a stretch: motors and corrections average out
constexpr double kMost = 40.0;       // stretches of a log: longer ones in longer logs
constexpr double kEnds = 1.0;        // s after take-off and before landing that are left out
constexpr double kDifference = 0.1;  // s to either side, for accelerations from a path
constexpr double kSample = 0.02;     // s between the moments of a stretch that are looked at
constexpr double kAloft = 0.3;       // share of the weight below which something else carries the vehicle
// From flight to flight the rotors of a vehicle that nobody touched scatter by some two per cent; a factor
// of e more or less is nothing unusual. The flights themselves decide where there are several.
constexpr double kUsualScatter = 0.02;
constexpr double kEqual = 0.1;      // rotors of one make, and where the battery sits
constexpr double kInCommon = 1e-3;  // what all rotors have in common is the thrust constant
constexpr double kLeastNoise = 1e-4;
// Where nothing is stated: what the flight does not tell either stays where it starts.
constexpr double kNothingKnown = 1.0;
const std::string kRatio = "rotor_mismatch.ratio@";

// The channels of a path, and how often it is differenced for accelerations.
struct Path {
  int channel, order;
};

double interpolated(const FlightArc& arc, int channel, double t) {
  const auto at = [&](std::size_t i) { return arc.y[i * kChannels + static_cast<std::size_t>(channel)]; };
  auto hi = static_cast<std::size_t>(std::ranges::lower_bound(arc.t, t) - arc.t.begin());
  std::size_t lo = hi == 0 ? 0 : hi - 1;
  while (hi < arc.rows() && !std::isfinite(at(hi))) ++hi;
  while (lo > 0 && !std::isfinite(at(lo))) --lo;
  if (hi >= arc.rows() || !std::isfinite(at(lo))) return kNaN;
  return hi == lo ? at(hi) : at(lo) + (t - arc.t[lo]) / (arc.t[hi] - arc.t[lo]) * (at(hi) - at(lo));
}

// Specific force that the path asks for at t, m/s^2.
double needed_at(const FlightArc& arc, const Path& path, double g, double t) {
  Eigen::Vector3d a;
  for (int k = 0; k < 3; ++k) {
    const auto at = [&](double s) { return interpolated(arc, path.channel + k, s); };
    const double h = path.order * kDifference;
    a[k] =
        path.order == 1 ? (at(t + h) - at(t - h)) / (2 * h) : (at(t + h) - 2 * at(t) + at(t - h)) / (h * h);
  }
  return (a - Eigen::Vector3d(0, 0, g)).norm();
}

// What noise of the path across the thrust adds to the mean size of what it asks for, m/s^2.
double rectified_noise(const FlightRecord& record, const Path& path) {
  double variance = 0;
  for (const std::size_t axis : {0U, 1U}) {
    const double white = record.sigma[static_cast<std::size_t>(path.channel) + axis];
    const double h = path.order * kDifference;
    variance += path.order == 1 ? white * white / (2 * h * h) : 6 * white * white / std::pow(h, 4);
  }
  return variance / (2 * record.vehicle->g);
}

// What the model's rotors do on the average of a stretch, with the vehicle level: thrust over mass, m/s^2,
// and moments about the centre of gravity over thrust, m.
Eigen::Vector4d mean_wrench(const FlightRecord& record, const std::vector<double>& p, const TrimStretch& s) {
  const FlightArc& arc = record.arcs[static_cast<std::size_t>(s.arc)];
  const EffectSet<double> effects(p, active_effects(p));
  Flight<double, EffectSet<double>> flight(*record.vehicle, p, effects, *arc.inputs);
  const double high = record.vehicle->ground_z - 1e3;  // no ground effect
  FlightState<double> level{
      {Vec4<double>(1, 0, 0, 0), Vec3<double>::Zero(), Vec3<double>::Zero(), Vec3<double>(0, 0, high)},
      {},
      {}};
  const std::size_t rotors = record.vehicle->rotors.size();
  const double from = arc.t[s.begin], to = arc.t[s.end - 1];
  double t = std::max(from - kEnds, arc.t.front());
  if (arc.inputs->commanded())
    for (std::size_t n = 0; n < rotors; ++n) level.motors[n] = {flight.steady_speed(n, t), 0.0};
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();  // N, N m
  double count = 0;
  for (; t < to; t += kSample) {
    if (arc.inputs->commanded())
      flight.advance(level.motors, t, kSample);
    else
      flight.rate(level, t);  // sets the motors from what was measured
    if (t < from) continue;
    auto steady = level.motors;  // what it takes to spin them up turns the vehicle to and fro
    for (MotorState<double>& motor : steady) motor.Omega_dot = 0.0;
    const Wrench<double> total =
        flight.body().wrench(level.body, Mat3<double>::Identity(), std::span(steady).first(rotors));
    const Vec3<double> M = total.M_B - cross(flight.body().centre_of_gravity(), total.F_B);
    sum += Eigen::Vector4d(-total.F_B[2], M[0], M[1], M[2]);
    count += 1;
  }
  sum.tail<3>() /= sum[0];
  sum[0] /= std::max(count, 1.0) * flight.body().mass();
  return sum;
}

Index rows_of(const Trim& trim) { return static_cast<Index>(trim.stretches.size()) * kTrimChannels; }

// Derivative of the unbalance over the thrust of each rotor.
MatrixXd ratio_slopes(const FlightRecord& record, const Trim& trim, const std::vector<double>& p) {
  constexpr double h = 1e-3;
  const auto rotors = static_cast<Index>(record.vehicle->rotors.size());
  MatrixXd A(rows_of(trim), rotors);
  for (Index k = 0; k < rotors; ++k) {
    const auto at = static_cast<std::size_t>(find_parameter(kRatio + std::to_string(k + 1))->index);
    std::vector<double> more = p, less = p;
    more[at] += h, less[at] -= h;
    A.col(k) = (unbalance(record, trim, more) - unbalance(record, trim, less)) / (2 * h);
  }
  return A;
}

MatrixXd covariance(const Trim& trim, const Eigen::Vector4d& noise, const MatrixXd& A, double scatter) {
  MatrixXd V = MatrixXd::Zero(rows_of(trim), rows_of(trim));
  for (std::size_t i = 0; i < trim.stretches.size(); ++i)
    for (std::size_t k = 0; k < trim.stretches.size(); ++k) {
      if (trim.stretches[i].log != trim.stretches[k].log) continue;
      const Index a = kTrimChannels * static_cast<Index>(i), b = kTrimChannels * static_cast<Index>(k);
      V.block<4, 4>(a, b) =
          scatter * scatter * A.middleRows<kTrimChannels>(a) * A.middleRows<kTrimChannels>(b).transpose();
      if (i == k) V.block<4, 4>(a, b).diagonal() += noise.cwiseAbs2();
    }
  return V;
}

// Calls with the first and the number of the stretches of each log.
template <class Each>
void for_logs(const Trim& trim, const Each& each) {
  for (std::size_t i = 0, end = 0; i < trim.stretches.size(); i = end) {
    while (end < trim.stretches.size() && trim.stretches[end].log == trim.stretches[i].log) ++end;
    each(static_cast<Index>(i), static_cast<Index>(end - i));
  }
}

// Stretches by column, about the mean of their log.
MatrixXd about_means(const Trim& trim, const VectorXd& y) {
  MatrixXd out = Eigen::Map<const MatrixXd>(y.data(), kTrimChannels, y.size() / kTrimChannels);
  for_logs(trim, [&](Index first, Index count) {
    auto own = out.middleCols(first, count);
    const Eigen::Vector4d mean = own.rowwise().mean();
    own.colwise() -= mean;
  });
  return out;
}

// Scatter of stretches about the mean of their log. A slow drift, of a battery that the model lacks, counts
// as noise: where it passed for information, the offset of the command would bend to follow it, and with it
// what the rotors' commands say of their thrust.
Eigen::Vector4d noise_of(const Trim& trim, const VectorXd& y) {
  const double degrees = static_cast<double>(trim.stretches.size()) - trim.logs;
  if (degrees < 1) return Eigen::Vector4d::Constant(kUsualScatter);
  return (about_means(trim, y).rowwise().squaredNorm() / degrees).cwiseSqrt().cwiseMax(kLeastNoise);
}

// Mean square over what the flights leave likely, everything that the constants may be taken out.
double scatter_of(const Trim& trim, const VectorXd& y, const Eigen::Vector4d& noise, const MatrixXd& A,
                  const MatrixXd& open) {
  std::vector<double> s, weight;
  for (double log_s = std::log(1e-3); log_s < std::log(0.3); log_s += 0.25) {
    s.push_back(std::exp(log_s));
    const Eigen::LLT<MatrixXd> llt(covariance(trim, noise, A, s.back()) + open);
    const double usual = log_s - std::log(kUsualScatter);
    weight.push_back(-llt.matrixLLT().diagonal().array().log().sum() - 0.5 * y.dot(llt.solve(y)) -
                     0.5 * usual * usual);
  }
  const double top = std::ranges::max(weight);
  double sum = 0, square = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double w = std::exp(weight[i] - top);
    sum += w, square += w * s[i] * s[i];
  }
  return std::sqrt(square / sum);
}

bool is_ratio(const FreeConstant& c) { return c.name.starts_with(kRatio); }

// Direction of the unknowns in which all rotors gain alike: it is held, not to be told from the constant. One
// of which nothing is known stands apart from the others.
VectorXd in_common(const Theta& theta) {
  VectorXd all = VectorXd::Zero(theta.size());
  double rotors = 0;
  for (int i = 0; i < theta.constants_count(); ++i)
    if (const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)];
        is_ratio(c) && c.prior_std && *c.prior_std < 1)
      all[i] = c.unit(), rotors += 1;
  return all / (std::max(rotors, 1.0) * kInCommon);
}

}  // namespace

bool only_trim(const Signals& logged) {
  return !logged.rates && !logged.attitude && (logged.velocity || logged.position) &&
         (logged.commands || logged.rotor_speeds);
}

bool states_rotor_ratios(const Vehicle& vehicle) {
  return std::ranges::any_of(vehicle.parameters, [](const auto& entry) {
    return entry.first.starts_with(kRatio) && entry.second.std.value_or(0.0) > 0;
  });
}

Trim make_trim(const FlightRecord& record, const std::vector<double>& p) {
  Trim trim;
  const double g = record.vehicle->g;
  trim.weight = p[param::m] * g, trim.drag = p[param::kQ] / p[param::kT];
  for (const Rotor& rotor : record.vehicle->rotors) trim.reach = std::max(trim.reach, rotor.r_B.norm());
  const Path path = record.signals.velocity ? Path{kVelocity, 1} : Path{kPosition, 2};
  const double rectified = rectified_noise(record, path);
  std::set<int> logs;
  for (std::size_t k = 0; k < record.arcs.size(); ++k) {
    const FlightArc& arc = record.arcs[k];
    const double from = arc.t.front() + kEnds, to = arc.t.back() - kEnds;
    const double length = std::max(kShortest, (to - from) / kMost);
    const auto row = [&](double t) {
      return static_cast<std::size_t>(std::ranges::lower_bound(arc.t, t) - arc.t.begin());
    };
    for (double begin = from; begin + length <= to; begin += length) {
      TrimStretch s{arc.log, static_cast<int>(k), row(begin), row(begin + length), begin + length / 2, 0.0};
      double sum = 0, count = 0;
      for (double t = begin; t < begin + length; t += kDifference)
        if (const double f = needed_at(arc, path, g, t); std::isfinite(f)) sum += f, count += 1;
      s.needed = sum / std::max(count, 1.0) - rectified;
      if (s.end <= s.begin + 1 || !(s.needed > kAloft * g)) continue;
      if (mean_wrench(record, p, s)[0] < kAloft * g) continue;
      trim.stretches.push_back(s);
      logs.insert(arc.log);
    }
  }
  trim.logs = static_cast<int>(logs.size());
  if (!(trim.reach > 0))
    throw DataError(
        "neither rates nor attitude were logged (or they never change), and a rotor at the origin "
        "balances whatever it does; log rates or attitude");
  if (trim.stretches.size() < 2)
    throw DataError(
        "neither rates nor attitude were logged (or they never change), and the flight is too short for the "
        "balance of its rotors: some 7 s aloft without a gap are needed; log rates or attitude");
  return trim;
}

VectorXd unbalance(const FlightRecord& record, const Trim& trim, const std::vector<double>& p) {
  VectorXd y(rows_of(trim));
  for (std::size_t k = 0; k < trim.stretches.size(); ++k) {
    Eigen::Vector4d w = mean_wrench(record, p, trim.stretches[k]);
    w[0] = w[0] / trim.stretches[k].needed - 1;
    w.tail<3>() /= trim.reach;
    // Balanced is balanced whatever the drag on the whole: less of it would only make an unbalance look
    // small.
    w[3] *= trim.drag * p[param::kT] / p[param::kQ];
    y.segment<kTrimChannels>(kTrimChannels * static_cast<Index>(k)) = w;
  }
  return y;
}

MatrixXd trim_slopes(const FlightRecord& record, const Trim& trim, const Theta& theta, const VectorXd& u) {
  constexpr double h = 1e-4;
  MatrixXd Y = MatrixXd::Zero(rows_of(trim), theta.size());
  for (int i = 0; i < theta.constants_count(); ++i) {
    // How fast rotors follow changes their mean thrust a little: too little to learn it from that.
    const int index = theta.constants()[static_cast<std::size_t>(i)].index;
    if (index == param::omega_m || index == param::zeta_m || index == param::dead_time) continue;
    VectorXd more = u, less = u;
    more[i] += h, less[i] -= h;
    Y.col(i) = (unbalance(record, trim, theta.p(more)) - unbalance(record, trim, theta.p(less))) / (2 * h);
  }
  return Y;
}

TrimFit fit_trim(const FlightRecord& record, const Trim& trim, const Theta& theta, bool hold_common,
                 const TrimFit* like) {
  constexpr int kSteps = 6;
  const bool scatter_known = states_rotor_ratios(*record.vehicle);
  TrimFit out;
  if (like) out.V = like->V, out.noise = like->noise, out.scatter = like->scatter;
  const VectorXd common = hold_common ? in_common(theta) : VectorXd::Zero(theta.size());
  VectorXd u = VectorXd::Zero(theta.size());
  MatrixXd H;
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<double> p = theta.p(u);
    out.y = unbalance(record, trim, p);
    const MatrixXd Y = trim_slopes(record, trim, theta, u);
    const PriorTerms prior = theta.prior(u);
    MatrixXd known = common * common.transpose();
    known.diagonal() += prior.slope.unaryExpr([](double s) { return s == 0 ? kNothingKnown : s * s; });
    // Scatter is found where the constants stand at first: what they explain then is not yet taken out.
    if (step < 2 && !like) {
      const MatrixXd A = ratio_slopes(record, trim, p);
      out.noise = noise_of(trim, out.y);
      const VectorXd priors = prior.slope.cwiseProduct(prior.residual) + common * common.dot(u);
      const VectorXd expected = out.y - Y * Eigen::LDLT<MatrixXd>(known).solve(priors);
      out.scatter = scatter_known && trim.logs < 2  // it is in their deviations
                        ? 0.0
                        : scatter_of(trim, expected, out.noise, A,
                                     Y * Eigen::LDLT<MatrixXd>(known).solve(MatrixXd(Y.transpose())));
      out.V = covariance(trim, out.noise, A, out.scatter);
    }
    const Eigen::LLT<MatrixXd> V(out.V);
    const MatrixXd WY = V.solve(Y);
    out.fit.information = Y.transpose() * WY;
    H = out.fit.information + known;
    const VectorXd g =
        WY.transpose() * out.y + prior.slope.cwiseProduct(prior.residual) + common * common.dot(u);
    const VectorXd du = -Eigen::LDLT<MatrixXd>(H).solve(g);
    out.fit.cost = out.y.dot(V.solve(out.y)) + prior.residual.squaredNorm() + std::pow(common.dot(u), 2);
    double widest = 1.0;  // of a logarithm
    for (int i = 0; i < theta.constants_count(); ++i)
      if (theta.constants()[static_cast<std::size_t>(i)].positive) widest = std::max(widest, std::abs(du[i]));
    if (step + 1 < kSteps) u += du / widest;
  }
  out.fit.u = u;
  out.fit.covariance = Eigen::LDLT<MatrixXd>(H).solve(MatrixXd::Identity(H.rows(), H.cols()));
  out.fit.naive_covariance = out.fit.covariance;
  out.fit.converged = u.allFinite() && out.fit.covariance.allFinite();
  out.beyond =
      out.fit.cost - (out.noise.cwiseInverse().asDiagonal() * about_means(trim, out.y)).squaredNorm();
  if (!out.fit.converged)
    throw DataError("the balance of these flights cannot be fitted: no number comes of it");
  return out;
}

Warning without_turning() {
  return {"no_turning",
          "neither rates nor attitude were logged: how the vehicle turned is not known, and so not what its "
          "rotors do from moment to moment. What is left is their balance over some seconds: thrust for a "
          "command, and the thrust of each rotor relative to the others. Motors, inertia, drag, delays and "
          "sensors cannot be seen; log rates or attitude"};
}

std::string scatter_in_words(const Trim& trim, double scatter) {
  if (scatter == 0)
    return "What a rotor's thrust scatters by from flight to flight is in its deviation as stated.";
  return fmt::format("From flight to flight the thrust of a rotor for a command scatters by {:.1f} %{}.",
                     100 * scatter, trim.logs == 1 ? ", as is usual: one flight does not tell" : "");
}

Section trim_section(const FlightRecord& record, const Trim& trim, const VectorXd& y) {
  Section section;
  section.title = "Balance of the rotors";
  section.text = fmt::format(
      "Thrust and moments of the rotors at the speeds of their commands, over {} stretches of {:.0f} s or "
      "more "
      "in {} log{}.",
      trim.stretches.size(), kShortest, trim.logs, trim.logs == 1 ? "" : "s");
  Table table{"What is left, in % of the weight (moments: of thrust times arm)",
              {"log", "stretches", "thrust", "Mx", "My", "Mz"},
              {}};
  for (int log = 0; log < record.logs; ++log) {
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    int count = 0;
    for (std::size_t k = 0; k < trim.stretches.size(); ++k)
      if (trim.stretches[k].log == log)
        sum += y.segment<kTrimChannels>(kTrimChannels * static_cast<Index>(k)), ++count;
    if (count == 0) continue;
    std::vector<std::string> row{std::to_string(log + 1), std::to_string(count)};
    for (Index c = 0; c < kTrimChannels; ++c) row.push_back(fmt::format("{:+.2f}", 100 * sum[c] / count));
    table.rows.push_back(std::move(row));
  }
  section.tables.push_back(std::move(table));
  return section;
}

void verify_trim(Result& result, const FlightRecord& record, const std::vector<double>& p) {
  const Trim trim = make_trim(record, p);
  const VectorXd y = unbalance(record, trim, p);
  result.warnings.push_back(without_turning());
  result.sections.push_back(trim_section(record, trim, y));
  result.fit["seconds"] = record.duration;
  result.fit["stretches"] = trim.stretches.size();
  const auto rms = [&](Index channel) {
    return std::sqrt(y(Eigen::seq(channel, Eigen::last, Index{kTrimChannels})).squaredNorm() /
                     static_cast<double>(trim.stretches.size()));
  };
  result.fit["unbalance"] = {{"thrust", rms(0)}, {"Mx", rms(1)}, {"My", rms(2)}, {"Mz", rms(3)}};
  result.verdict = fmt::format(
      "Nothing can be simulated without rates or attitude. Over {:.0f} s of flight the thrust of the model's "
      "rotors is {:.1f} % off what the path needs (RMS), and their moments {:.1f} % of thrust times arm off "
      "balance.",
      record.duration, 100 * rms(0), 100 * std::hypot(rms(1), rms(2), rms(3)));
}

std::vector<FreeConstant> trim_constants(const FlightRecord& record, const std::vector<double>& p,
                                         std::vector<std::string> also) {
  for (std::size_t k = 1; k <= record.vehicle->rotors.size(); ++k) also.push_back(kRatio + std::to_string(k));
  std::vector<FreeConstant> constants = free_constants(*record.vehicle, p, also);
  if (!record.signals.commands) leave_out_motors(constants);
  for (FreeConstant& c : constants)
    if (is_ratio(c) && !c.prior_std) c.prior_value = c.start, c.prior_std = kEqual;
  return constants;
}

void refine_trim(Result& result, const FlightRecord& record, const std::vector<double>& p,
                 const std::vector<std::string>& free) {
  const Theta theta(p, trim_constants(record, p, free), record.logs, false);
  const Trim trim = make_trim(record, p);
  TrimFit found = fit_trim(record, trim, theta, true);
  // What is written serves for the next flight, and that scatters too.
  for (int i = 0; i < theta.constants_count(); ++i)
    if (const FreeConstant& c = theta.constants()[static_cast<std::size_t>(i)]; is_ratio(c))
      found.fit.covariance(i, i) += std::pow(std::max(found.scatter, kUsualScatter) / c.unit(), 2);
  result.warnings.push_back(without_turning());
  if (trim.logs == 1 && found.scatter > 0)
    result.warn("one_flight", fmt::format("how much the rotors' balance changes from flight to flight is not "
                                          "known from one: {:.0f} % is assumed; give several logs",
                                          100 * found.scatter));
  result.parameters = flight_parameters(theta, found.fit, "flightlog");
  result.fit["seconds"] = record.duration;
  result.fit["stretches"] = trim.stretches.size();
  result.fit["rotor_scatter"] = found.scatter;
  warn_about(result, theta, found.fit);
  result.sections.push_back(trim_section(record, trim, found.y));
  result.sections.back().text += " " + scatter_in_words(trim, found.scatter);
  int known = 0;
  for (const Parameter& q : result.parameters) known += q.identifiable;
  result.verdict = fmt::format(
      "Without rates or attitude {:.0f} s of flight tell the balance of the rotors only: {} of {} "
      "parameters.",
      record.duration, known, result.parameters.size());
}

}  // namespace ident
