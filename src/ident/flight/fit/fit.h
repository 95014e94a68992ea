// Fits the shared unknowns to flight: Ceres steps over the smoother, noise levels from the data, a covariance
// corrected for coloured residuals.
#pragma once

#include <functional>
#include <memory>

#include "ident/flight/smoother/smoother.h"

namespace ident {

struct FlightFitOptions {
  double chunk_seconds = 0.0;  ///< 0: chosen from the noise that is found
  bool estimate_noise = true;
  std::optional<NoiseModel> noise;  ///< to start from
  Eigen::VectorXd start;            ///< unknowns to start from; empty: u = 0
  int noise_rounds = 10;
  bool rough_noise = false;  ///< noise to 10 % is enough: models are compared under a common one
  int most_steps = 0;      ///< of the shared unknowns; a fit that needs more has not converged. 0: any number
  bool robust = true;      ///< count gross errors linearly
  bool fine_gusts = true;  ///< chunks so short that no gust within them acts as information on the vehicle
  bool choose_axes = true;     ///< whether gusts keep their direction in the world or turn with the vehicle
  double block_seconds = 2.0;  ///< of the sandwich covariance
  double tolerance = 0.01;     ///< decrease of the cost (twice the log likelihood) not worth an evaluation
  double tolerance_of_misfit = 0.0;  ///< the same, as a share of the cost in excess of noise
  bool exact = true;                 ///< ends with fine steps and slopes as precise as needed: see finish_fit
  Steps steps = Steps::fine;         ///< until then; cheaper ones are used where they make no difference
  std::shared_ptr<const FlightSmoother> near;  ///< smoother of a similar model, whose states to start from
  int threads = 0;
  std::function<void(double)> progress;  ///< share done
};

struct FlightFit {
  Eigen::VectorXd u;
  Eigen::MatrixXd information;       ///< of u, from the data alone
  Eigen::MatrixXd covariance;        ///< of u, priors included, corrected for the colour of the residuals
  Eigen::MatrixXd naive_covariance;  ///< the same as if residuals were white
  double cost = 0.0;
  NoiseModel noise;
  double chunk_seconds = 0.0;
  int steps = 0;
  bool converged = false;
  Steps serves = Steps::fine;      ///< the cheapest steps that make no difference in this flight
  std::vector<ScoreBlock> blocks;  ///< scores by blocks of `block_seconds`
  std::shared_ptr<FlightSmoother>
      smoother;  ///< before the last small step; refers to the record and theta of the call
};

/// Fit of `theta` to the record; both must outlive the result.
FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options = {});

}  // namespace ident
