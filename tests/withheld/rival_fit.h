// Least squares of the rival: whitened residuals, priors on the base, training and held-out blocks in turn.
#pragma once

#include <set>

#include "rival_model.h"

namespace rival {

// An autoregressive filter and the size of its innovations for each series.
class Whitening {
 public:
  Whitening() = default;
  explicit Whitening(const std::vector<Series>& residuals);

  // All series of all logs below each other, each divided by its innovation's standard deviation.
  VectorXd operator()(const std::vector<Series>& residuals) const;
  MatrixXd filtered(std::size_t series, const MatrixXd& columns) const;
  // Sum of log(sigma) over the rows with the mask set.
  double log_sigma(const std::vector<Series>& residuals, const std::vector<bool>& mask) const;

 private:
  std::array<VectorXd, kSeries> filter_;
  std::array<double, kSeries> sigma_;
};

// Every other five seconds are held out; which rows of the stacked residual these are.
bool is_held_out(double t);
std::vector<bool> held_out(const std::vector<Log>& logs, const std::vector<Series>& residuals);

struct Fit {
  std::set<int> free;      // effects' parameters that the fit has
  std::set<int> released;  // base parameters without their prior
  VectorXd theta;
  MatrixXd covariance;     // of all base and free parameters
  std::vector<int> order;  // of the covariance's rows
  double held_out = 0;     // log-likelihood of the held-out rows
};

class Fitter {
 public:
  Fitter(const Model& model, const std::vector<Log>& logs);

  Fit start() const;  // base parameters only
  Fit with(const Fit& from, const Cause& cause, int rounds) const;
  // Log-likelihood that each cause would win on the training rows, to first order.
  std::vector<double> screen(const Fit& fit) const;
  const std::vector<bool>& mask() const { return mask_; }

 private:
  void improve(Fit* fit, int rounds) const;
  MatrixXd columns(const VectorXd& theta, const std::vector<int>& parameters,
                   const Whitening& whitening) const;
  std::vector<int> nuisances(const Fit& fit) const;

  const Model& model_;
  std::vector<bool> mask_;
  int base_count_;
};

}  // namespace rival
