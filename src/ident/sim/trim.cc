// Finds the hover by Gauss-Newton on the six accelerations.
#include "ident/sim/trim.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "ident/core/error.h"

namespace ident {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vec4<double> tilted(double phi, double theta) {
  return quaternion_product(Vec4<double>(std::cos(theta / 2), 0, std::sin(theta / 2), 0),
                            Vec4<double>(std::cos(phi / 2), std::sin(phi / 2), 0, 0));
}

/// Unknowns: rotor speeds over the nominal one, then roll and pitch.
class HoverProblem {
 public:
  HoverProblem(const Plant& plant, double height) : plant_(plant), height_(height) {
    const double lift = plant.constant(param::m) * plant.vehicle().g;
    nominal_ = std::sqrt(lift / (static_cast<double>(rotors()) * plant.constant(param::kT)));
  }
  std::size_t rotors() const { return plant_.vehicle().rotors.size(); }
  double nominal() const { return nominal_; }

  BodyState<double> state(const Eigen::VectorXd& u) const {
    const auto n = static_cast<Eigen::Index>(rotors());
    const Vec3<double> rest = Vec3<double>::Zero();
    return {tilted(u[n], u[n + 1]), rest, rest, Vec3<double>(0, 0, plant_.vehicle().ground_z - height_)};
  }
  std::vector<double> speeds(const Eigen::VectorXd& u) const {
    std::vector<double> Omega;
    for (std::size_t n = 0; n < rotors(); ++n) Omega.push_back(u[static_cast<Eigen::Index>(n)] * nominal_);
    return Omega;
  }
  Vector6 accelerations(const Eigen::VectorXd& u) const {
    const BodyRate<double> rate = plant_.steady_rate(state(u), speeds(u));
    return (Vector6() << rate.w_dot_B, rate.v_dot_W).finished();
  }
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& u) const {
    constexpr double step = 1e-5;
    Eigen::MatrixXd J(6, u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      Eigen::VectorXd up = u, down = u;
      up[i] += step, down[i] -= step;
      J.col(i) = (accelerations(up) - accelerations(down)) / (2 * step);
    }
    return J;
  }

 private:
  const Plant& plant_;
  double height_, nominal_ = 1.0;
};

Eigen::VectorXd solve(const HoverProblem& problem, const std::string& who) {
  const auto n = static_cast<Eigen::Index>(problem.rotors());
  Eigen::VectorXd u = Eigen::VectorXd::Ones(n + 2);
  u.tail(2).setZero();
  for (int i = 0; i < 50; ++i) {
    const Vector6 a = problem.accelerations(u);
    if (a.norm() < 1e-9) return u;
    // Rows scaled, so that slow and quick axes count alike; the least change of all that solve it.
    const Eigen::MatrixXd J = problem.jacobian(u);
    const Vector6 weight = J.rowwise().norm().cwiseMax(1e-9).cwiseInverse();
    const Eigen::MatrixXd scaled = weight.asDiagonal() * J;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition(scaled.rows(), scaled.cols());
    decomposition.setThreshold(1e-7);
    decomposition.compute(scaled);
    Eigen::VectorXd change = -decomposition.solve(Eigen::VectorXd(weight.cwiseProduct(a)));
    const double largest = change.cwiseAbs().maxCoeff();
    if (largest > 0.3) change *= 0.3 / largest;
    u += change;
    u.head(n) = u.head(n).cwiseMax(0.05);
  }
  if (problem.accelerations(u).norm() < 1e-6) return u;
  throw UsageError(who + ": cannot hover: no rotor speeds balance its forces and moments at rest");
}

}  // namespace

Trim hover_trim(const Plant& plant, double height) {
  const Vehicle& vehicle = plant.vehicle();
  const std::string who = vehicle.file.empty() ? std::string("vehicle") : vehicle.file;
  const HoverProblem problem(plant, height);
  const Eigen::VectorXd u = solve(problem, who);
  Trim trim;
  trim.Omega = problem.speeds(u);
  const double km = plant.constant(param::km), offset = plant.constant(param::Omega_0);
  trim.Omega_least = std::max(offset + 0.03 * km, 0.01 * km), trim.Omega_most = offset + km;
  for (const double Omega : trim.Omega) {
    if (Omega < trim.Omega_least || Omega > 0.98 * trim.Omega_most)
      throw UsageError(
          fmt::format("{}: cannot hover: a rotor would need {:.4g} rad/s, its commands give {:.4g} "
                      "to {:.4g} rad/s",
                      who, Omega, trim.Omega_least, trim.Omega_most));
    trim.delta.push_back((Omega - offset) / km);
  }
  const BodyState<double> hover = problem.state(u);
  trim.q_WB = hover.q_WB;
  trim.up_B = -rotation(hover.q_WB).row(2).transpose();
  const auto n = static_cast<Eigen::Index>(problem.rotors());
  const Eigen::MatrixXd J = problem.jacobian(u).leftCols(n);
  trim.effect.resize(4, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double per_square = 1.0 / (2.0 * u[i] * problem.nominal() * problem.nominal());
    trim.effect.col(i) << J.col(i).head<3>() * per_square, -J(5, i) * per_square;
  }
  Eigen::Matrix<double, 4, Eigen::Dynamic> scaled = trim.effect;
  for (Eigen::Index row = 0; row < 4; ++row) scaled.row(row) /= std::max(scaled.row(row).norm(), 1e-30);
  if (Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues()[3] < 1e-3)
    throw UsageError(who + ": cannot be controlled: its rotors do not span roll, pitch, yaw and lift");
  return trim;
}

}  // namespace ident
