// Prior information on the state where an arc begins, and the links between chunks: their slopes and weights.
#include <algorithm>
#include <cmath>

#include "ident/core/simd/dense_rows.h"
#include "ident/flight/smoother/smoother.h"

namespace ident {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double length(const FlightRecord& record, const ChunkPlace& place) {
  const FlightArc& arc = record.arcs[static_cast<std::size_t>(place.arc)];
  return arc.t[place.end] - arc.t[place.begin];
}

// Variances that stand for "no such noise": far below what one chunk can tell of an acceleration from outside
// ((rad/s^2)^2 and (m/s^2)^2) or of a slow error.
constexpr double kLeastOutside = 1e-10, kLeastShown = 1e-14;

// Floor of the links of rotor speeds, as a multiple of that of the other states. The noise of motors may be
// zero; at the floor of the other states the rounding of single precision would then act through these links,
// and a diagnosis would name it.
constexpr double kMotorFloor = 100.0;

// Information on states that an arc does not measure: 10 rad/s, 1 rad, 20 m/s, 100 m. Of more than four
// rotors some combinations leave the motion unchanged: 30 rad/s and 3000 rad/s^2.
constexpr double kUnseenRate = 1e-2, kUnseenAttitude = 1.0, kUnseenVelocity = 2.5e-3, kUnseenPlace = 1e-4;
constexpr int kAllTold = 4;  // rotors whose speeds the motion alone determines
constexpr double kUnseenSpeed = 1e-3, kUnseenSpeeding = 1e-7;
// Weaker information, 300 rad/s and 30000 rad/s^2, where speeds are hardly determined: of up to four rotors
// when only rates and forces were logged, whose samples may be ten times as far apart as motors settle; of
// all rotors when some may stand still. Thrust is not linear over larger steps.
constexpr double kHardlySeenSpeed = 1e-5, kHardlySeenSpeeding = 1e-9;
// A motor that settles within a row leaves no trace of how its speed was changing when the arc began. The
// rate of its speed is then bounded by half of the usual speed within its lag, relative to the scale of
// speeds.
constexpr double kOfItsSpeed = 0.5;

double usual_speed(const FlightArc& arc, std::size_t rotor) {
  double sum = 0;
  for (std::size_t i = 0; i < arc.rows(); ++i) sum += arc.motors[i * arc.rotors() + rotor].Omega;
  return sum / static_cast<double>(arc.rows());
}

std::array<bool, kChannels> measured_in(const FlightArc& arc) {
  std::array<bool, kChannels> seen{};
  for (std::size_t i = 0; i < arc.y.size(); ++i) seen[i % kChannels] |= std::isfinite(arc.y[i]);
  return seen;
}

}  // namespace

// Information on those parts of the state at the start of an arc that no sensor of the arc measures. An
// undetermined state would take the precision of all others with it.
VectorXd FlightSmoother::unseen_in(const FlightArc& arc) const {
  const StateLayout& layout = record_->layout;
  const std::array<bool, kChannels> seen = measured_in(arc);
  VectorXd info = VectorXd::Zero(layout.size);
  const auto assume = [&](int at, double least, int channel, int derived_from) {
    for (int i = 0; i < 3 && at >= 0; ++i)
      if (!seen[static_cast<std::size_t>(channel + i)] && !seen[static_cast<std::size_t>(derived_from + i)])
        info[at + i] = least;
  };
  assume(layout.w, kUnseenRate, kGyro, kAttitude);
  assume(layout.attitude, kUnseenAttitude, kAttitude, kAttitude);
  assume(layout.v, kUnseenVelocity, kVelocity, kPosition);
  assume(layout.x, kUnseenPlace, kPosition, kPosition);
  const bool untold = layout.rotors > kAllTold && !arc.stood,
             hardly = !untold && (layout.attitude < 0 || arc.stood);
  const std::vector<double>& p = record_->p;
  const double lag = 2 * p[param::zeta_m] / p[param::omega_m];
  const bool fast = 2 * p[param::zeta_m] * p[param::omega_m] * record_->interval > 1;
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    if (seen[static_cast<std::size_t>(kRotorChannel + n)]) continue;
    const int at = layout.motors + n;
    if (untold || hardly) {
      info[at] = untold ? kUnseenSpeed : kHardlySeenSpeed;
      info[at + layout.rotors] = untold ? kUnseenSpeeding : kHardlySeenSpeeding;
    } else if (const double speed = fast ? usual_speed(arc, static_cast<std::size_t>(n)) : 0.0; speed > 0) {
      info[at + layout.rotors] = std::pow(lag / (kOfItsSpeed * speed), 2);
    }
  }
  return info;
}

const AirNoise& FlightSmoother::air_of(std::size_t k) const {
  return noise_.in_log(record_->arcs[static_cast<std::size_t>(places_[k].arc)].log);
}

// The parts of the state of chunk k that follow a Gauss-Markov process.
std::array<FlightSmoother::Process, 2 + kShownGroups> FlightSmoother::processes(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const AirNoise& air = air_of(k);
  std::array<Process, 2 + kShownGroups> all = {Process{layout.w_dot, &air.w_dot, 0, kLeastOutside},
                                               Process{layout.v_dot, &air.v_dot, 3, kLeastOutside}};
  for (std::size_t g = 0; g < kShownGroups; ++g)
    all[2 + g] = {layout.shown_error[g], &noise_.slow[g], -1, kLeastShown};
  return all;
}

// Share of each component of the state that is carried over to the next chunk.
VectorXd FlightSmoother::carried(std::size_t k) const {
  VectorXd share = VectorXd::Ones(record_->layout.size);
  const double h = length(*record_, places_[k]);
  for (const Process& process : processes(k))
    for (int i = 0; i < 3 && process.at >= 0; ++i) share[process.at + i] = process.axis(i).carried(h);
  return share;
}

void FlightSmoother::set_input_errors() {
  input_errors_.clear();
  if (std::ranges::none_of(record_->arcs, [](const FlightArc& arc) { return arc.speed_errors != nullptr; }))
    return;
  for (const ChunkPlace& place : places_)
    input_errors_.push_back(ident::input_error(*record_, record_->arcs[static_cast<std::size_t>(place.arc)],
                                               place.begin, place.end, noise_.axes));
}

double FlightSmoother::input_error(std::size_t k, int axis) const {
  return input_errors_.empty() || axis < 0 ? 0.0 : input_errors_[k][axis];
}

// Variance that the error of the input adds to a link: the error is independent from chunk to chunk.
double FlightSmoother::new_error(std::size_t k, int axis, double carried) const {
  return input_error(k + 1, axis) + carried * carried * input_error(k, axis);
}

// Information on the state at the start of an arc, before any measurement.
VectorXd FlightSmoother::start_information(std::size_t k) const {
  VectorXd info = unseen_[static_cast<std::size_t>(places_[k].arc)];
  for (const Process& process : processes(k))
    for (int i = 0; i < 3 && process.at >= 0; ++i) {
      const double sigma = process.axis(i).sigma;
      info[process.at + i] = 1 / (sigma * sigma + process.least + input_error(k, process.input_axis(i)));
    }
  return info;
}

// The parts that follow a process, at their places in the local state of chunk k.
VectorXd FlightSmoother::outside(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  VectorXd x = VectorXd::Zero(layout.size);
  if (layout.w_dot >= 0) x.segment<3>(layout.w_dot) = trial_[k].outside.w_dot_B;
  if (layout.v_dot >= 0) x.segment<3>(layout.v_dot) = trial_[k].outside.v_dot;
  for (std::size_t g = 0; g < kShownGroups; ++g)
    if (layout.shown_error[g] >= 0) x.segment<3>(layout.shown_error[g]) = trial_[k].shown_error[g];
  return x;
}

// Rotor speeds that were not measured are known up to a scale, which is km. Gives the slot of km among the
// shared unknowns and the relative change of the speeds with one unit of it.
std::optional<FlightSmoother::SpeedScale> FlightSmoother::scale_of_speeds() const {
  const std::vector<FreeConstant>& constants = theta_->constants();
  const auto km = std::ranges::find(constants, int{param::km}, &FreeConstant::index);
  if (km == constants.end() || record_->layout.motors < 0 || record_->signals.rotor_speeds) return {};
  const auto slot = static_cast<int>(km - constants.begin());
  return SpeedScale{slot, theta_->slope(trial_u_, slot) / theta_->physical(trial_u_, slot)};
}

// Derivative of the expected state at the start of an arc over the shared unknowns: accelerations follow
// their profiles, rotor speeds their scale. Otherwise the information that stands in for unmeasured speeds
// would determine km.
MatrixXd FlightSmoother::start_slope(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const Index own = theta_->size();
  MatrixXd slope = MatrixXd::Zero(layout.size, shared());
  if (shared() > own) slope.rightCols(shared() - own) = profile(k);
  const std::optional<SpeedScale> scale = scale_of_speeds();
  for (int n = 0; n < layout.rotors && scale; ++n) {
    const MotorState<double>& motor = trial_[k].motors[static_cast<std::size_t>(n)];
    slope(layout.motors + n, scale->slot) = scale->share * motor.Omega;
    slope(layout.motors + layout.rotors + n, scale->slot) = scale->share * motor.Omega_dot;
  }
  return slope;
}

Index FlightSmoother::shared() const {
  return theta_->size() + (profiles_.empty() ? 0 : profiles_[0].cols());
}

// The profiles of chunk k within the local state.
MatrixXd FlightSmoother::profile(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  MatrixXd P = MatrixXd::Zero(layout.size, profiles_[k].cols());
  if (layout.w_dot >= 0) P.middleRows<3>(layout.w_dot) = profiles_[k].topRows<3>();
  const Eigen::MatrixXd push = profiles_[k].bottomRows<3>();
  if (layout.v_dot >= 0)
    P.middleRows<3>(layout.v_dot) =
        noise_.axes == GustAxes::world ? push : rotation(states_[k].body.q_WB).transpose() * push;
  return P;
}

// Derivative of the defect of chunk k, with the next state held: over its state from column 0 on, over the
// shared unknowns from column padded(n) on. Without the carried shares, see set_shares().
chunk::RowMatrix FlightSmoother::link_slope(std::size_t k) const {
  const Index n = record_->layout.size, m = theta_->size(), from = padded(record_->layout.size);
  chunk::RowMatrix E = chunk::RowMatrix::Zero(n, from + padded(static_cast<int>(shared()) + 1));
  const chunk::ConstRowMap whole = chunk::E(results_[k], record_->layout.size);
  E.leftCols(n) = whole.leftCols(n);
  E.middleCols(from, m) = whole.rightCols(m);
  // The floor of unmeasured rotor speeds is proportional to km (link_weight), so what counts is the defect
  // over km.
  if (const std::optional<SpeedScale> scale = scale_of_speeds())
    E.col(from + scale->slot).segment(record_->layout.motors, 2 * record_->layout.rotors) -=
        scale->share * defect(k).segment(record_->layout.motors, 2 * record_->layout.rotors);
  return E;
}

// Sets the part of such a slope that depends on the noise: the share that is carried over. A process is
// constant over a chunk and depends on nothing else.
void FlightSmoother::set_shares(std::size_t k, chunk::RowMatrix& E) const {
  const VectorXd share = carried(k);
  for (const Process& process : processes(k))
    for (int i = process.at; process.at >= 0 && i < process.at + 3; ++i) E(i, i) = share[i];
  // The process is the acceleration less its profile.
  if (!profiles_.empty())
    E.middleCols(padded(record_->layout.size) + theta_->size(), shared() - theta_->size()) =
        profile(k + 1) - share.asDiagonal() * profile(k);
}

// Inverse variance of the defect: the new part of a process, q h for rotor speeds, and for all other states a
// floor far below what the measurements of one chunk can tell, so that they continue.
VectorXd FlightSmoother::link_weight(std::size_t k) const {
  const StateLayout& layout = record_->layout;
  const double h = length(*record_, places_[k]),
               rows = static_cast<double>(places_[k].end - places_[k].begin);
  const auto floor = [&](int channel, double otherwise) {
    const auto c = static_cast<std::size_t>(channel);
    const double s = record_->sigma[c] != 1.0 ? noise_.sigma[c] : otherwise;  // 1: not measured
    return 1e-5 * s * s / rows;
  };
  VectorXd W(layout.size);
  const auto continues = [&](int at, int channel) {
    for (int i = 0; i < 3 && at >= 0; ++i) W[at + i] = 1.0 / floor(channel + i, 0.01);
  };
  continues(layout.w, kGyro), continues(layout.attitude, kAttitude);
  continues(layout.v, kVelocity), continues(layout.x, kPosition);
  // Places and velocities that are not measured drift by more than the digits of a double: they start anew in
  // each chunk.
  const VectorXd& unseen = unseen_[static_cast<std::size_t>(places_[k].arc)];
  for (const int at : {layout.v, layout.x})
    for (int i = at; at >= 0 && i < at + 3; ++i)
      if (unseen[i] > 0) W[i] = unseen[i];
  for (const Process& process : processes(k))
    for (int i = 0; i < 3 && process.at >= 0; ++i) {
      const ColouredNoise& axis = process.axis(i);
      const double share = axis.carried(h);
      W[process.at + i] = 1.0 / (axis.sigma * axis.sigma * (1 - share * share) + process.least +
                                 new_error(k, process.input_axis(i), share));
    }
  // Not the present omega_m: with its square as a weight faster motors would make their noise cheap.
  const double rate = record_->motor_rate;
  // The floor of unmeasured speeds is proportional to their scale. Otherwise lower speeds would have more
  // freedom, and the cost would fall with km.
  const double speeds = theta_->p(trial_u_)[param::km] / theta_->p(VectorXd::Zero(theta_->size()))[param::km];
  for (int n = 0; n < layout.rotors && layout.motors >= 0; ++n) {
    const double f = noise_.q_motor * h + kMotorFloor * floor(kRotorChannel + n, 5.0 * speeds);
    W[layout.motors + n] = 1.0 / f;
    W[layout.motors + layout.rotors + n] = 1.0 / (f * rate * rate);
  }
  return W;
}

}  // namespace ident
