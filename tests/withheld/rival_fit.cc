// Gauss-Newton with numerical derivatives; held-out likelihood with a filter learnt on the training rows.
#include "rival_fit.h"

#include <algorithm>
#include <cmath>

namespace rival {

namespace {

constexpr int kOrder = 6;

// Yule-Walker equations from the autocovariance of both logs.
VectorXd autoregression(const std::vector<const VectorXd*>& parts) {
  VectorXd r = VectorXd::Zero(kOrder + 1);
  for (const VectorXd* x : parts) {
    for (int lag = 0; lag <= kOrder && lag < x->size(); ++lag)
      r[lag] += x->head(x->size() - lag).dot(x->tail(x->size() - lag));
  }
  if (r[0] <= 0) return VectorXd::Zero(kOrder);
  MatrixXd R(kOrder, kOrder);
  for (int i = 0; i < kOrder; ++i) {
    for (int j = 0; j < kOrder; ++j) R(i, j) = r[std::abs(i - j)];
  }
  R.diagonal().array() += 1e-6 * r[0];
  return R.ldlt().solve(r.tail(kOrder));
}

VectorXd innovations(const VectorXd& x, const VectorXd& filter) {
  VectorXd e = x;
  for (Eigen::Index lag = 1; lag <= filter.size() && lag < x.size(); ++lag)
    e.tail(x.size() - lag) -= filter[lag - 1] * x.head(x.size() - lag);
  e.head(std::min<Eigen::Index>(kOrder, e.size())).setZero();
  return e;
}

}  // namespace

Whitening::Whitening(const std::vector<Series>& residuals) {
  for (std::size_t s = 0; s < kSeries; ++s) {
    std::vector<const VectorXd*> parts;
    for (const Series& log : residuals) parts.push_back(&log[s]);
    filter_[s] = autoregression(parts);
    double sum = 0, count = 0;
    for (const VectorXd* x : parts) {
      const VectorXd e = innovations(*x, filter_[s]);
      sum += e.squaredNorm();
      count += static_cast<double>(e.size());
    }
    sigma_[s] = count > 0 ? std::sqrt(std::max(sum / count, 1e-24)) : 1;
  }
}

VectorXd Whitening::operator()(const std::vector<Series>& residuals) const {
  Eigen::Index size = 0, at = 0;
  for (const Series& log : residuals) {
    for (const VectorXd& x : log) size += x.size();
  }
  VectorXd all(size);
  for (const Series& log : residuals) {
    for (std::size_t s = 0; s < kSeries; ++s) {
      all.segment(at, log[s].size()) = innovations(log[s], filter_[s]) / sigma_[s];
      at += log[s].size();
    }
  }
  return all;
}

MatrixXd Whitening::filtered(std::size_t series, const MatrixXd& columns) const {
  MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    result.col(i) = innovations(columns.col(i), filter_[series]) / sigma_[series];
  return result;
}

double Whitening::log_sigma(const std::vector<Series>& residuals, const std::vector<bool>& mask) const {
  double sum = 0;
  std::size_t at = 0;
  for (const Series& log : residuals) {
    for (std::size_t s = 0; s < kSeries; ++s) {
      for (Eigen::Index i = 0; i < log[s].size(); ++i, ++at) sum += mask[at] ? std::log(sigma_[s]) : 0;
    }
  }
  return sum;
}

bool is_held_out(double t) { return static_cast<int>(t / 5) % 2 == 1; }

std::vector<bool> held_out(const std::vector<Log>& logs, const std::vector<Series>& residuals) {
  std::vector<bool> mask;
  for (std::size_t l = 0; l < logs.size(); ++l) {
    for (std::size_t s = 0; s < kSeries; ++s) {
      for (Eigen::Index i = 0; i < residuals[l][s].size(); ++i) {
        const auto row = static_cast<std::size_t>(i);
        const bool sparse = s >= 6 && s < 12;
        const double t = logs[l].blocks[sparse ? logs[l].fixes[row] : row].t;
        mask.push_back(is_held_out(t));
      }
    }
  }
  return mask;
}

Fitter::Fitter(const Model& model, const std::vector<Log>& logs)
    : model_(model), mask_(held_out(logs, model.residuals(model.null()))), base_count_(0) {
  while (model.parameters()[static_cast<std::size_t>(base_count_)].prior > 0) ++base_count_;
}

std::vector<int> Fitter::nuisances(const Fit& fit) const {
  std::vector<int> all;
  for (int i = 0; i < base_count_; ++i) all.push_back(i);
  all.insert(all.end(), fit.free.begin(), fit.free.end());
  return all;
}

// Signatures: minus the change of the residual per unit of the parameter.
MatrixXd Fitter::columns(const VectorXd& theta, const std::vector<int>& parameters,
                         const Whitening& whitening) const {
  const VectorXd from = whitening(model_.residuals(theta));
  MatrixXd X(from.size(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Parameter& parameter = model_.parameters()[static_cast<std::size_t>(parameters[i])];
    VectorXd moved = theta, before = theta;
    const bool by_wind = parameter.name.rfind("wind.", 0) == 0;  // wind is seen through drag only
    const int drag = model_.index("rotor_drag.kd");
    if (by_wind && before[drag] < 0.1 * model_.typical_drag())
      before[drag] = moved[drag] = model_.typical_drag();
    moved[parameters[i]] += parameter.step;
    const VectorXd base = by_wind ? whitening(model_.residuals(before)) : from;
    X.col(static_cast<Eigen::Index>(i)) = (base - whitening(model_.residuals(moved))) / parameter.step;
  }
  return X;
}

void Fitter::improve(Fit* fit, int rounds) const {
  fit->order = nuisances(*fit);
  const auto n = static_cast<Eigen::Index>(fit->order.size());
  Whitening whitening;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Series> residuals = model_.residuals(fit->theta);
    whitening = Whitening(residuals);
    VectorXd r = whitening(residuals);
    MatrixXd X = columns(fit->theta, fit->order, whitening);
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      if (!mask_[static_cast<std::size_t>(i)]) continue;
      r[i] = 0;
      X.row(i).setZero();
    }
    MatrixXd A = X.transpose() * X;
    VectorXd b = X.transpose() * r;
    for (Eigen::Index i = 0; i < n; ++i) {
      const int index = fit->order[static_cast<std::size_t>(i)];
      const Parameter& p = model_.parameters()[static_cast<std::size_t>(index)];
      if (p.prior <= 0 || fit->released.count(index) > 0) continue;
      A(i, i) += 1 / (p.prior * p.prior);
      b[i] += (p.null - fit->theta[index]) / (p.prior * p.prior);
    }
    const VectorXd scale = A.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    MatrixXd S = scale.asDiagonal() * A * scale.asDiagonal();
    S.diagonal().array() += 1e-9;
    const MatrixXd inverse = S.inverse();
    fit->covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
    const VectorXd step = fit->covariance * b;
    for (Eigen::Index i = 0; i < n; ++i) fit->theta[fit->order[static_cast<std::size_t>(i)]] += step[i];
    for (const char* name : {"motor_delay.tau", "sensor_delay.tau", "rotor_drag.kd", "payload.m"}) {
      fit->theta[model_.index(name)] = std::max(0.0, fit->theta[model_.index(name)]);
    }
    for (const char* name : {"m", "kT", "kQ", "km", "omega_m", "zeta_m", "Jxx", "Jyy", "Jzz"}) {
      const int i = model_.index(name);
      const double null = model_.parameters()[static_cast<std::size_t>(i)].null;
      fit->theta[i] = std::clamp(fit->theta[i], 0.2 * null, 5 * null);
    }
    double& slow = fit->theta[model_.index("motor_asymmetry.slow")];
    slow = std::clamp(slow, -0.5, 0.8);
  }
  const std::vector<Series> residuals = model_.residuals(fit->theta);
  whitening = Whitening(residuals);
  const VectorXd e = whitening(residuals);
  fit->held_out = -whitening.log_sigma(residuals, mask_);
  for (Eigen::Index i = 0; i < e.size(); ++i)
    fit->held_out -= mask_[static_cast<std::size_t>(i)] ? 0.5 * e[i] * e[i] : 0;
}

Fit Fitter::start() const {
  Fit fit;
  fit.theta = model_.null();
  improve(&fit, 3);
  return fit;
}

Fit Fitter::with(const Fit& from, const Cause& cause, int rounds) const {
  Fit fit = from;
  for (const int index : cause.parameters) {
    if (index < base_count_)
      fit.released.insert(index);
    else
      fit.free.insert(index);
  }
  if (cause.name == "wind") {
    double& kd = fit.theta[model_.index("rotor_drag.kd")];
    kd = std::max(kd, 0.5 * model_.typical_drag());
  }
  improve(&fit, rounds);
  return fit;
}

std::vector<double> Fitter::screen(const Fit& fit) const {
  const std::vector<Series> residuals = model_.residuals(fit.theta);
  const Whitening whitening(residuals);
  std::vector<int> all;
  for (int i = 0; i < static_cast<int>(model_.parameters().size()); ++i) all.push_back(i);
  MatrixXd X(whitening(residuals).size(), static_cast<Eigen::Index>(all.size()) + 1);
  X << columns(fit.theta, all, whitening), whitening(residuals);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    if (mask_[static_cast<std::size_t>(i)]) X.row(i).setZero();
  }
  VectorXd scale = X.colwise().norm();
  for (Eigen::Index i = 0; i + 1 < X.cols(); ++i) X.col(i) /= std::max(scale[i], 1e-300);
  const MatrixXd G = X.transpose() * X;
  const std::vector<int> fixed = nuisances(fit);
  const auto gain_with = [&](const std::vector<int>& used, const std::set<int>& released) {
    const auto n = static_cast<Eigen::Index>(used.size());
    MatrixXd A(n, n);
    VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const int row = used[static_cast<std::size_t>(i)];
      b[i] = G(row, G.cols() - 1);
      for (Eigen::Index j = 0; j < n; ++j) A(i, j) = G(row, used[static_cast<std::size_t>(j)]);
      const double prior = model_.parameters()[static_cast<std::size_t>(row)].prior;
      A(i, i) += 1e-7;
      if (prior > 0 && released.count(row) == 0 && scale[row] > 0)
        A(i, i) += std::pow(1 / (prior * scale[row]), 2);
    }
    return 0.5 * b.dot(A.ldlt().solve(b));
  };
  const double without = gain_with(fixed, fit.released);
  std::vector<double> gains;
  for (const Cause& cause : model_.causes()) {
    std::vector<int> used = fixed;
    std::set<int> released = fit.released;
    for (const int index : cause.parameters) {
      if (index < base_count_) {
        released.insert(index);
      } else if (fit.free.count(index) == 0) {
        used.push_back(index);
      }
    }
    gains.push_back(gain_with(used, released) - without);
  }
  return gains;
}

}  // namespace rival
