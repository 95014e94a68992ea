// Numerical linearisation, exact discretisation, Riccati equation by doubling.
#include "ident/sim/regulator.h"

#include <Eigen/LU>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBody = 12;

/// v' and w' at a deviation of (v, rotation, w, Omega) from hover.
VectorXd accelerations(const Plant& plant, const Trim& trim, double height, const VectorXd& z) {
  const Vec3<double> turn = z.segment<3>(6);
  BodyState<double> body;
  body.x_W = Vec3<double>(0, 0, plant.vehicle().ground_z - height) + z.segment<3>(0);
  body.v_W = z.segment<3>(3);
  body.q_WB = quaternion_product(trim.q_WB, Vec4<double>(quaternion_from_rotation_vector(turn)));
  body.w_B = z.segment<3>(9);
  std::vector<double> Omega = trim.Omega;
  for (std::size_t n = 0; n < Omega.size(); ++n) Omega[n] += z[kBody + static_cast<Eigen::Index>(n)];
  const BodyRate<double> rate = plant.steady_rate(body, Omega);
  return (VectorXd(6) << rate.v_dot_W, rate.w_dot_B).finished();
}

/// Continuous time: z' = A z + B delta, with Omega and Omega' of each rotor last.
void continuous(const Plant& plant, const Trim& trim, double height, MatrixXd& A, MatrixXd& B) {
  const auto rotors = static_cast<Eigen::Index>(trim.Omega.size());
  const Eigen::Index speeds = kBody, rates = kBody + rotors, size = kBody + 2 * rotors;
  A = MatrixXd::Zero(size, size), B = MatrixXd::Zero(size, rotors);
  A.block<3, 3>(0, 3).setIdentity();
  A.block<3, 3>(6, 9).setIdentity();
  for (Eigen::Index i = 0; i < kBody + rotors; ++i) {
    const double step = i < kBody ? 1e-5 : 1e-5 * trim.Omega_most;
    VectorXd up = VectorXd::Zero(kBody + rotors), down = up;
    up[i] = step, down[i] = -step;
    const VectorXd slope =
        (accelerations(plant, trim, height, up) - accelerations(plant, trim, height, down)) / (2 * step);
    A.block(3, i, 3, 1) = slope.head(3);
    A.block(9, i, 3, 1) = slope.tail(3);
  }
  const double w = plant.constant(param::omega_m), zeta = plant.constant(param::zeta_m);
  for (Eigen::Index n = 0; n < rotors; ++n) {
    A(speeds + n, rates + n) = 1.0;
    A(rates + n, speeds + n) = -w * w;
    A(rates + n, rates + n) = -2 * zeta * w;
    B(rates + n, n) = w * w * plant.constant(param::km);
  }
}

/// exp(A h) and the integral of exp(A s) B over 0 to h.
void discretise(const MatrixXd& A, const MatrixXd& B, double h, MatrixXd& F, MatrixXd& G) {
  MatrixXd both = MatrixXd::Zero(A.rows() + B.cols(), A.rows() + B.cols());
  both.topLeftCorner(A.rows(), A.cols()) = A * h;
  both.topRightCorner(B.rows(), B.cols()) = B * h;
  const MatrixXd result = both.exp();
  F = result.topLeftCorner(A.rows(), A.cols());
  G = result.topRightCorner(B.rows(), B.cols());
}

}  // namespace

LinearModel hover_model(const Plant& plant, const Trim& trim, double height, double interval) {
  MatrixXd A, B;
  continuous(plant, trim, height, A, B);
  const auto rotors = B.cols(), size = A.rows();
  // A command arrives `whole` intervals later and a part of one.
  const int whole = static_cast<int>(plant.command_delay() / interval);
  const double part = plant.command_delay() - whole * interval;
  LinearModel model;
  model.delayed = plant.command_delay() > 0 ? whole + 1 : 0;
  MatrixXd F, G, F_rest, G_old, G_new;
  discretise(A, B, interval, F, G);
  discretise(A, B, interval - part, F_rest, G_new);
  G_old = G - G_new;  // by linearity: what the older command leaves over
  const Eigen::Index total = size + model.delayed * rotors;
  model.A = MatrixXd::Zero(total, total), model.B = MatrixXd::Zero(total, rotors);
  model.A.topLeftCorner(size, size) = F;
  const auto add = [&](int steps_ago, const MatrixXd& effect) {
    if (steps_ago == 0)
      model.B.topRows(size) += effect;
    else
      model.A.block(0, size + (steps_ago - 1) * rotors, size, rotors) += effect;
  };
  add(whole, G_new);
  if (model.delayed > 0) add(whole + 1, G_old);
  for (int k = 0; k < model.delayed; ++k) {
    const MatrixXd one = MatrixXd::Identity(rotors, rotors);
    if (k == 0)
      model.B.middleRows(size, rotors) = one;
    else
      model.A.block(size + k * rotors, size + (k - 1) * rotors, rotors, rotors) = one;
  }
  return model;
}

MatrixXd regulator_gain(const LinearModel& model, int rotors) {
  const Eigen::Index size = model.A.rows();
  const double tolerance[kBody] = {0.4, 0.4, 0.4, 1, 1, 1, 0.2, 0.2, 0.4, 3, 3, 3};
  MatrixXd H = MatrixXd::Zero(size, size), A = model.A;
  for (int i = 0; i < kBody; ++i) H(i, i) = 1.0 / (tolerance[i] * tolerance[i]);
  const MatrixXd R = MatrixXd::Identity(rotors, rotors) / (0.15 * 0.15);
  MatrixXd G = model.B * R.inverse() * model.B.transpose();
  const MatrixXd one = MatrixXd::Identity(size, size);
  for (int i = 0; i < 40; ++i) {
    const Eigen::PartialPivLU<MatrixXd> W(one + G * H);
    const MatrixXd WA = W.solve(A), WG = W.solve(G);
    const MatrixXd gained = A.transpose() * H * WA;
    G += A * WG * A.transpose();
    A = A * WA;
    H += gained;
    H = (0.5 * (H + H.transpose())).eval();
    if (gained.norm() < 1e-12 * H.norm()) break;
  }
  const MatrixXd& X = H;
  return (R + model.B.transpose() * X * model.B).ldlt().solve(model.B.transpose() * X * model.A);
}

}  // namespace ident
