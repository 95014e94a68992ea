// A chain of chunks over all arcs: evaluates them on all cores, links them, and eliminates their states in
// time order.
//
//   cost = sum_chunks rho(r_k(x_k, theta)^2) + sum_links d_k' W_k d_k ,   d_k = end(x_k, theta) - x_(k+1)
//
// W_k is the inverse covariance of a process noise: white angular and linear acceleration of spectral density
// q_w, q_v acting over the chunk. Zero noise makes one long output-error fit, infinite noise unlinked
// segments. The states are a block tridiagonal system with a border of shared unknowns; elimination costs
// O(length).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ident/estimators/flight_record.h"
#include "ident/estimators/flight_theta.h"

namespace ident {

/// Spectral densities of the process noise, and the white noise of every channel.
struct NoiseModel {
  std::array<double, kChannels> sigma{};
  double q_w = 0.0;      ///< (rad/s^2)^2 s
  double q_v = 0.0;      ///< (m/s^2)^2 s
  double q_motor = 0.0;  ///< (rad/s)^2/s on rotor speeds
};

/// Where a chunk lies.
struct ChunkPlace {
  int arc = 0;
  std::size_t begin = 0, end = 0;
  bool linked = false;  ///< to the next one
};

/// Normal equations of the shared unknowns after elimination: cost(u + du) ~ cost + 2 g'du + du'S du.
struct ReducedSystem {
  double cost = 0.0;  ///< at the best states for u, to second order
  Eigen::VectorXd g;
  Eigen::MatrixXd S;
};

struct Moments {
  std::array<double, kChannels> square{}, leverage{}, count{};
  // Process noise: squared whitened defects, their posterior variance and number, for w, v and motors.
  std::array<double, 3> defect_square{}, defect_variance{}, defect_count{};
};

class FlightSmoother {
 public:
  FlightSmoother(const FlightRecord& record, const Theta& theta, NoiseModel noise, double chunk_seconds,
                 int threads = 0);

  const FlightRecord& record() const { return *record_; }
  const Theta& theta() const { return *theta_; }
  const NoiseModel& noise() const { return noise_; }
  const std::vector<ChunkPlace>& chunks() const { return places_; }
  double chunk_seconds() const { return chunk_seconds_; }

  /// Linearises at u and the states predicted for it, and eliminates the states. Priors are not in it.
  const ReducedSystem& linearize(const Eigen::VectorXd& u);
  /// Makes the last linearisation the one from which states are predicted from now on.
  void accept();
  /// Moves the states to their best for u (`rounds` Gauss-Newton steps) and accepts.
  void settle(const Eigen::VectorXd& u, int rounds = 2);

  /// Takes over states, from a smoother with the same chunks.
  void set_states(const std::vector<FlightState<double>>& states) { states_ = trial_ = states; }

  /// Another noise model; the states stay.
  void set_noise(const NoiseModel& noise);
  /// A delay of rates and attitude about which to linearise, s.
  void set_shift(double shift) { shift_ = shift; }
  /// Residuals beyond this many standard deviations count linearly.
  void set_huber(double huber) { huber_ = huber; }

  /// Residual moments for re-estimating the noise, at the accepted states.
  Moments moments();

  /// Projected scores, one column per block of about `seconds`: their sum is the gradient; for the sandwich.
  /// With `information` also the information of each block, which adds up to S.
  Eigen::MatrixXd block_scores(double seconds, std::vector<Eigen::MatrixXd>* information = nullptr);

  /// State at the last row of each arc, from all data before it, with its covariance.
  struct End {
    FlightState<double> x;
    Eigen::MatrixXd P;
  };
  std::vector<End> arc_ends();

  /// The accepted states, and weighted residuals [row][kChannels] of each chunk there.
  const std::vector<FlightState<double>>& states() const { return states_; }
  std::vector<std::vector<double>> residuals();
  /// Defect of each link at the accepted states, after `residuals()`; empty where there is no link.
  std::vector<Eigen::VectorXd> defects() const;

 private:
  ChunkTask task(std::size_t k, const Eigen::VectorXd& u, const std::vector<double>& p,
                 const std::vector<std::vector<Seed>>& seeds) const;
  void predict(const Eigen::VectorXd& u);
  void evaluate(const Eigen::VectorXd& u, bool jacobian, bool leverage);
  void eliminate();
  Eigen::VectorXd defect(std::size_t k) const;
  Eigen::MatrixXd link_weight(std::size_t k) const;
  FlightState<double> moved(const FlightState<double>& x, const Eigen::VectorXd& dx) const;
  void posterior_covariances();

  const FlightRecord* record_;
  const Theta* theta_;
  NoiseModel noise_;
  double chunk_seconds_;
  int threads_;
  double shift_ = 0.0, huber_ = 4.0;
  std::vector<ChunkPlace> places_;
  std::vector<FlightState<double>> states_, trial_;  // accepted, and those of the last linearisation
  std::vector<ChunkResult> results_;
  Eigen::VectorXd u_, trial_u_;  // of the accepted and of the last linearisation
  // Of the accepted linearisation: x_k moves by -(f_k + B_k du) - G_k dx_(k+1).
  struct Elimination {
    std::vector<Eigen::MatrixXd> G, B, P, cross;
    std::vector<Eigen::VectorXd> f;
  };
  Elimination accepted_, trial_elimination_;
  std::vector<Eigen::MatrixXd> D_inverse_;
  ReducedSystem reduced_;
};

}  // namespace ident
