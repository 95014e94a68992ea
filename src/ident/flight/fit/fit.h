// Fits the shared unknowns to flight: Ceres steps over the smoother, noise levels from the data, honest
// covariance.
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
  bool rough_noise = false;  ///< to a tenth is enough: models are compared under one common to them
  int most_steps = 0;      ///< of the shared unknowns; a fit that needs more has not converged. 0: any number
  bool robust = true;      ///< count gross errors linearly
  bool fine_gusts = true;  ///< chunks so short that no gust within them passes for information on the vehicle
  bool choose_axes = true;     ///< whether gusts keep their direction in the world or turn with the vehicle
  double block_seconds = 2.0;  ///< of the sandwich covariance
  double tolerance = 0.01;     ///< fall of the cost (twice the log likelihood) that is worth no evaluation
  double tolerance_of_misfit = 0.0;  ///< the same as a share of the cost beyond that of noise alone
  bool exact = true;                 ///< ends with fine steps, and slopes as precise as shows: see finish_fit
  Steps steps = Steps::fine;         ///< until then; others, which cost less, only where that does not show
  std::shared_ptr<const FlightSmoother> near;  ///< of a like model, whose states to start from
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
  Steps serves = Steps::fine;      ///< those of the options, or finer ones, that do not show in this flight
  std::vector<ScoreBlock> blocks;  ///< what stretches of `block_seconds` say
  std::shared_ptr<FlightSmoother>
      smoother;  ///< before the last small step; refers to the record and theta of the call
};

/// Fit of `theta` to the record; both must outlive the result.
FlightFit fit_flight(const FlightRecord& record, const Theta& theta, const FlightFitOptions& options = {});

/// Fall of the cost that a step has to promise to be looked at: more than the tolerance, and than a share of
/// what the model misses altogether.
double worth_a_step(const FlightSmoother& smoother, const FlightFitOptions& options);

/// Brings a fit to where less than `options.tolerance` of a fall is left, finds its information and
/// covariance there, and takes what is left by one more step of Newton's, which is not evaluated. Steps are
/// fine ones if it is to be exact, and slopes then in double precision where the rounding of single
/// precision would pass for information. For a fit that was made with a larger tolerance; one that is
/// `at_minimum` of single precision is not looked at for it once more.
void finish_fit(FlightFit& fit, const Theta& theta, const FlightFitOptions& options, bool at_minimum = false);

/// The shared unknowns as the first `training_share` of every arc would have them: one Newton step from the
/// fit.
Eigen::VectorXd fit_of_training(const FlightFit& fit, const FlightRecord& record, const Theta& theta,
                                double training_share);

/// Covariance of u from `draws` block bootstraps: blocks drawn with repetition, one Newton step from the fit
/// for each draw; what the priors say is drawn anew with them. Seeded.
Eigen::MatrixXd bootstrap_covariance(const FlightFit& fit, const Theta& theta, int draws);

/// Levels of noise to start from: white noise from differences, a generous process noise.
NoiseModel initial_noise(const FlightRecord& record);

/// Noise levels from the last linearisation, which had leverages: `rounds` steps for the process noise, one
/// for the sensors; returns the largest relative change of a standard deviation.
double update_noise(FlightSmoother& smoother, int rounds);

/// Gives gusts the axes, those of the world or those of the body, that make the flight more likely; the
/// world's where it does not say. The smoother has those of the world, and noise that is about right. Whether
/// it is beyond doubt, or no matter.
bool choose_axes(FlightSmoother& smoother, const Eigen::VectorXd& u);

/// Chunks short enough for that noise, s; `fine`: see FlightFitOptions.
double chunk_for(const FlightRecord& record, const NoiseModel& noise, bool fine = true);

}  // namespace ident
