// Levenberg-Marquardt by forward differences over a target's entries, each in a unit of its own.
#include "best_model.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace mended {

namespace {

struct Move {
  std::function<void(TargetModel&, double)> by;  // x units from the start
  double least = -1e9, most = 1e9;               // of x
};

// How far a constant may go from the truth. Without bounds the best file for a vehicle whose trim moment the
// target cannot hold has an infinite inertia: not turning at all is then the better forecast.
constexpr double kConstant = 0.4, kLag = 0.7;       // of the logarithm
constexpr double kFactor = 0.25, kOffFactor = 0.5;  // of the Cholesky factor of second moments: 65 % of them
constexpr double kAxis = 0.17, kCentre = 0.3;       // rad; of the arm
constexpr double kLowest = 0.3;                     // of the full speed
using Moves = std::vector<Move>;

// Second moments of mass: integral(r r' dm). Positive definite means that J is one of a body.
Eigen::Matrix3d second_moments(const Eigen::Matrix3d& J) {
  return 0.5 * J.trace() * Eigen::Matrix3d::Identity() - J;
}

void scale(double& value, double x) { value *= std::exp(x); }

void add_body(const TargetModel& start, Moves& moves) {
  // Entries of the Cholesky factor of the second moments, so that every step leads to a body.
  const double unit = 0.3 * std::sqrt(second_moments(start.J).diagonal().maxCoeff());
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column <= row; ++column)
      moves.push_back({[=](TargetModel& m, double x) {
                         Eigen::Matrix3d L = Eigen::LLT<Eigen::Matrix3d>(second_moments(m.J)).matrixL();
                         L(row, column) =
                             row == column ? L(row, row) * std::exp(x) : L(row, column) + unit * x;
                         const Eigen::Matrix3d P = L * L.transpose();
                         m.J = P.trace() * Eigen::Matrix3d::Identity() - P;
                       },
                       row == column ? -kFactor : -kOffFactor, row == column ? kFactor : kOffFactor});
  if (start.target == "px4-sih") return;
  const double arm = start.rotors[0].r.norm();
  for (int i = 0; i < 3; ++i)
    moves.push_back({[=](TargetModel& m, double x) {
                       m.c[i] += arm * x;
                       for (TargetRotor& rotor : m.rotors) rotor.r[i] -= arm * x;
                     },
                     -kCentre, kCentre});
}

void add_rotors(const TargetModel& start, Moves& moves) {
  const bool each = start.target == "gz" || start.target == "mujoco";
  if (!each) {
    moves.push_back({[](TargetModel& m, double x) {
                       for (TargetRotor& rotor : m.rotors) scale(rotor.kT, x);
                     },
                     -kConstant, kConstant});
    moves.push_back({[](TargetModel& m, double x) {
                       for (TargetRotor& rotor : m.rotors) scale(rotor.kQ, x);
                     },
                     -kConstant, kConstant});
    return;
  }
  for (std::size_t n = 0; n < kRotors; ++n) {
    moves.push_back({[n](TargetModel& m, double x) { scale(m.rotors[n].kT, x); }, -kConstant, kConstant});
    moves.push_back({[n](TargetModel& m, double x) { scale(m.rotors[n].kQ, x); }, -kConstant, kConstant});
    for (int axis = 0; axis < 2; ++axis)
      moves.push_back({[=](TargetModel& m, double x) {
                         m.rotors[n].a = Eigen::AngleAxisd(x, Vector3d::Unit(axis)) * m.rotors[n].a;
                       },
                       -kAxis, kAxis});
  }
}

void add_motor(const TargetModel& start, Moves& moves) {
  if (start.target == "gz") {
    moves.push_back({[](TargetModel& m, double x) { scale(m.tau_up, x); }, -kLag, kLag});
    moves.push_back({[](TargetModel& m, double x) { scale(m.tau_down, x); }, -kLag, kLag});
    const double momentum = 0.01 * start.J(0, 0);
    moves.push_back(
        {[=](TargetModel& m, double x) { m.momentum += momentum * x; }, -start.momentum / momentum});
  } else {
    moves.push_back({[](TargetModel& m, double x) {
                       scale(m.tau_up, x);
                       m.tau_down = m.tau_up;
                     },
                     -kLag, kLag});
  }
  if (start.target == "rotorpy")
    moves.push_back(
        {[](TargetModel& m, double x) { m.low += m.full * x; }, -start.low / start.full, kLowest});
}

void add_air(const TargetModel& start, Moves& moves) {
  const double rate = 0.5 * start.m, hover = start.hover_motor();  // 0.5 1/s of drag
  if (start.target == "px4-sih")
    moves.push_back(
        {[=](TargetModel& m, double x) { m.linear_drag += rate * x; }, -start.linear_drag / rate});
  const double per_hub = rate / (kRotors * hover);
  if (start.target == "gz" || start.target == "rotorpy")
    moves.push_back({[=](TargetModel& m, double x) { m.kd += per_hub * x; }, -start.kd / per_hub});
  if (start.target != "rotorpy") return;
  moves.push_back({[=](TargetModel& m, double x) { m.kz += per_hub * x; }, -start.kz / per_hub});
  moves.push_back({[=](TargetModel& m, double x) { m.kh += 0.1 * rate * x; }});
  const double arm = start.rotors[0].r.norm();
  moves.push_back({[=](TargetModel& m, double x) { m.k_flap += 0.1 * per_hub * arm * x; }});
  for (int i = 0; i < 3; ++i)
    moves.push_back(
        {[=](TargetModel& m, double x) { m.c_D[i] += 0.1 * rate * x; }, -start.c_D[i] / (0.1 * rate)});
}

TargetModel moved(const TargetModel& start, const Moves& moves, const Eigen::VectorXd& x) {
  TargetModel out = start;
  for (std::size_t i = 0; i < moves.size(); ++i) moves[i].by(out, x[static_cast<Eigen::Index>(i)]);
  out.J_inverse = out.J.inverse();
  return out;
}

}  // namespace

bool is_body(const TargetModel& m) {
  return m.J.allFinite() && Eigen::LLT<Eigen::Matrix3d>(second_moments(m.J)).info() == Eigen::Success;
}

Fit fit_best(const TargetModel& start, const std::vector<TrueFlight>& flights, const Horizon& horizon,
             const Errors& unit) {
  Moves moves;
  add_body(start, moves), add_rotors(start, moves), add_motor(start, moves), add_air(start, moves);
  const auto n = static_cast<Eigen::Index>(moves.size());
  const auto at = [&](const Eigen::VectorXd& x) {
    return residuals(moved(start, moves, x), flights, horizon, unit);
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n), r = at(x), least(n), most(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    least[i] = moves[static_cast<std::size_t>(i)].least;
    most[i] = moves[static_cast<std::size_t>(i)].most;
  }
  double damping = 1e-3, cost = r.squaredNorm();
  constexpr double kStep = 1e-5, kEnough = 1e-4;  // relative decrease of the cost
  constexpr int kRounds = 30;
  int round = 0;
  for (; round < kRounds; ++round) {
    Eigen::MatrixXd jacobian(r.size(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::VectorXd beside = x;
      beside[i] += kStep;
      jacobian.col(i) = (at(beside) - r) / kStep;
    }
    // A number at its bound that would go beyond stays there in this round.
    for (Eigen::Index i = 0; i < n; ++i) {
      const double uphill = jacobian.col(i).dot(r);
      if ((x[i] <= least[i] && uphill > 0) || (x[i] >= most[i] && uphill < 0)) jacobian.col(i).setZero();
    }
    const Eigen::MatrixXd H = jacobian.transpose() * jacobian;
    const Eigen::VectorXd b = jacobian.transpose() * r;
    double won = 0;
    for (int trial = 0; trial < 8 && won <= 0; ++trial) {
      Eigen::MatrixXd damped = H;
      damped.diagonal() += damping * H.diagonal() + Eigen::VectorXd::Constant(n, 1e-9 * H.trace());
      const Eigen::VectorXd next = (x - damped.ldlt().solve(b)).cwiseMax(least).cwiseMin(most);
      const TargetModel candidate = moved(start, moves, next);
      const Eigen::VectorXd there = is_body(candidate) ? at(next) : Eigen::VectorXd();
      won = there.size() > 0 ? 1 - there.squaredNorm() / cost : -1;
      damping = won > 0 ? std::max(damping / 5, 1e-9) : damping * 6;
      if (won > 0) x = next, r = there, cost = there.squaredNorm();
    }
    if (won < kEnough) break;
  }
  return {moved(start, moves, x), pooled(rms(r, unit), unit), static_cast<int>(n), round};
}

}  // namespace mended
