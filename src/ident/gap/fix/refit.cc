// Gauss-Newton steps with slopes by differences, shortened until they gain.
#include "ident/gap/fix/refit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/math.h"
#include "ident/core/parallel.h"
#include "ident/effects/catalogue.h"
#include "ident/flight/ladder/model_along.h"
#include "ident/flight/ladder/window_residuals.h"
#include "ident/flight/prepare.h"
#include "ident/flight/smoother/parameterisation.h"
#include "ident/io/simulators/value.h"

namespace ident {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kOfGained = 0.01;  // a hundredth of what was gained counts as one
constexpr double kSame = 0.5;       // root mean square in those units: no difference
constexpr double kWide = 0.3;       // unit of a positive constant: of itself
constexpr double kFarthest = 0.7;   // most a logarithm moves: a factor of 2
constexpr double kApart = 1e-3;     // for differences
constexpr int kSteps = 12, kHalvings = 6;

// The flight as a simulator of that vehicle is flown: by commands, where there are such.
FlightRecord flown_by(const Vehicle& vehicle, FlightRecord record) {
  record.vehicle = &vehicle;
  if (!record.signals.commands) return record;
  record.signals.rotor_speeds = false;
  for (FlightArc& arc : record.arcs)
    for (std::size_t i = 0; i < arc.rows(); ++i)
      for (std::size_t n = 0; n < arc.rotors(); ++n) arc.y[i * kChannels + kRotorChannel + n] = kNaN;
  return record;
}

// Windows of the flight, and the unit of what the forces of a model give over them.
struct Flown {
  explicit Flown(const FlightRecord& record) : motion(measured_motion(record)) {
    if (motion.arcs.empty() || !motion.forces) return;
    windows = windows_of(motion, FitTo::forces);
    double square = 0;
    for (const Window& w : windows) square += gained(w).squaredNorm();
    const double rms = std::sqrt(square / std::max<double>(1.0, static_cast<double>(windows.size())));
    if (rms > 0) unit = kOfGained * rms;
  }

  Vec3<double> gained(const Window& w) const {
    const MeasuredArc& arc = motion.arcs[w.arc];
    return arc.gained_W[w.end] - arc.gained_W[w.begin];
  }

  // What is missed of the measured motion, in that unit.
  VectorXd missed(const std::vector<double>& p) const {
    return missed_in(motion, windows, FitTo::forces, model_along(motion, p)) / unit;
  }

  MeasuredMotion motion;
  std::vector<Window> windows;
  double unit = 1.0;
};

bool is_of_moments(const std::string& name) {
  return name.starts_with("J") || name == "kQ" || name.starts_with("cg_offset.") ||
         name.starts_with("blade_flapping.");
}

// What a file may state otherwise of its forces. What is weighed stays; so does the lag, with the mean delay.
std::vector<FreeConstant> constants_of(const Vehicle& held, const std::vector<double>& p) {
  std::vector<std::string> also;
  for (const auto& [name, known] : held.parameters)
    if (!name.starts_with("rotor_mismatch.")) also.push_back(name);
  std::vector<FreeConstant> out = free_constants(held, p, also);
  std::erase_if(out, [&](const FreeConstant& c) {
    const bool motor = c.index == param::zeta_m || c.index == param::omega_m || c.index == param::dead_time;
    return is_of_moments(c.name) || motor || c.index == param::m || !held.has(c.name) ||
           (c.positive && !(c.start > 0));
  });
  for (FreeConstant& c : out) c.prior_std.reset(), c.known_with.clear();
  return out;
}

double unit_of(const FreeConstant& c) { return c.positive ? kWide : 1.0; }

class Refit {
 public:
  Refit(const Flown& flown, const Theta& theta, VectorXd target)
      : flown_(flown), theta_(theta), target_(std::move(target)), units_(theta.size()) {
    for (int i = 0; i < theta.size(); ++i)
      units_[i] = unit_of(theta.constants()[static_cast<std::size_t>(i)]);
  }

  VectorXd difference(const VectorXd& u) const { return flown_.missed(theta_.p(u)) - target_; }

  VectorXd run() const {
    VectorXd u = VectorXd::Zero(theta_.size()), d = difference(u);
    for (int step = 0; step < kSteps; ++step) {
      const MatrixXd J = slopes(u, d);
      const VectorXd known = units_.cwiseAbs2().cwiseInverse();
      const MatrixXd A = J.transpose() * J + MatrixXd(known.asDiagonal());
      VectorXd by = -A.ldlt().solve(VectorXd(J.transpose() * d + known.cwiseProduct(u)));
      if (!by.allFinite()) return u;
      const double before = cost(u, d);
      bool gained = false;
      for (int halving = 0; halving < kHalvings && !gained; ++halving, by /= 2) {
        const VectorXd there = (u + by).cwiseMax(-kFarthest).cwiseMin(kFarthest), seen = difference(there);
        gained = seen.allFinite() && cost(there, seen) < before;
        if (gained) u = there, d = seen;
      }
      if (!gained || before - cost(u, d) < 1e-6 * before) return u;
    }
    return u;
  }

 private:
  double cost(const VectorXd& u, const VectorXd& d) const {
    return d.squaredNorm() + u.cwiseQuotient(units_).squaredNorm();
  }

  MatrixXd slopes(const VectorXd& u, const VectorXd& here) const {
    MatrixXd J(here.size(), u.size());
    in_parallel(static_cast<std::size_t>(u.size()), [&](std::size_t i) {
      const auto k = static_cast<Index>(i);
      VectorXd moved = u;
      moved[k] += kApart;
      J.col(k) = (difference(moved) - here) / kApart;
    });
    return J;
  }

  const Flown& flown_;
  const Theta& theta_;
  VectorXd target_, units_;
};

}  // namespace

Vehicle refitted(const Vehicle& held, const Vehicle& identified, std::span<const FlightLog> logs) {
  Vehicle out = held;
  try {
    Result unused;
    const FlightEntry entry = enter_flight(identified, logs, unused);
    const FlightRecord by_whole = flown_by(identified, entry.record), by_held = flown_by(held, entry.record);
    const Flown whole(by_whole), file(by_held);
    const VectorXd target = whole.missed(parameter_vector(identified));
    const std::vector<double> p = parameter_vector(held);
    const Theta theta(p, constants_of(held, p), 1, false);
    if (target.size() == 0 || theta.size() == 0) return out;
    const Refit refit(file, theta, target);
    const VectorXd before = refit.difference(VectorXd::Zero(theta.size()));
    if (!(before.norm() > kSame * std::sqrt(static_cast<double>(before.size())))) return out;
    const VectorXd u = refit.run();
    for (int i = 0; i < theta.size(); ++i)
      out.parameters[theta.constants()[static_cast<std::size_t>(i)].name].value =
          as_stated(theta.physical(u, i));
  } catch (const DataError&) {  // no flight: the file holds what it held
  }
  return out;
}

}  // namespace ident
