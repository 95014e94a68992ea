// Smooths flight: one chain of chunks for each arc, simulated on all cores, linked, and eliminated in time
// order. Long chains are eliminated from both ends.
//
//     cost = sum_chunks rho(r_k(x_k, theta)^2) + sum_links d_k' W_k d_k ,   d_k = end(x_k, theta) - x_(k+1)
//
// The state holds the accelerations from outside and the slow errors of sensors. Both are constant over a
// chunk and follow a Gauss-Markov process from one chunk to the next; all other states continue without a
// jump. Without process noise this is one long output-error fit, with infinite noise a set of unlinked
// segments. The states form a block tridiagonal system with a border of shared unknowns; elimination costs
// O(length). The theory is in flight/README.md.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ident/flight/kernel/noise_model.h"
#include "ident/flight/record/flight_record.h"
#include "ident/flight/smoother/chunk_maps.h"
#include "ident/flight/smoother/input_error.h"
#include "ident/flight/smoother/parameterisation.h"

namespace ident {

/// One chunk: rows [begin, end) of an arc.
struct ChunkPlace {
  int arc = 0;
  std::size_t begin = 0, end = 0;
  bool linked = false;  ///< to the next chunk of the arc
};

/// Normal equations of the shared unknowns after elimination: cost(u + du) ~ cost + 2 g'du + du'S du.
struct ReducedSystem {
  double cost = 0.0;  ///< with the states at their optimum for u, to second order
  double fall = 0.0;  ///< decrease of the cost from the present states to their optimum
  Eigen::VectorXd g;
  Eigen::MatrixXd S;
  double log_det = 0.0;  ///< of the states' information, less that of links and arc starts
};

/// Per channel: sum of the squared weighted residuals, sum of the leverages of the states, number of samples.
struct Moments {
  std::array<double, kChannels> square{}, leverage{}, count{};
};

/// Score (half gradient) and information of a block of time. Over all blocks they add up to those of the
/// reduced system.
struct ScoreBlock {
  int arc = 0;
  double from = 0.0, to = 0.0;  ///< s
  Eigen::VectorXd score;
  Eigen::MatrixXd information;
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

  /// Linearises at u, with the states predicted for it, and eliminates the states. The priors are not
  /// included. With `leverage`, moments() may be called afterwards.
  const ReducedSystem& linearize(const Eigen::VectorXd& u, bool leverage = false);
  /// Eliminates the last linearisation again, after a change of the process noise.
  const ReducedSystem& relinearize();
  /// Information of the last linearisation on each shared unknown, if all states were known.
  Eigen::VectorXd information_of_held_states() const;
  /// The reduced system of the last elimination.
  const ReducedSystem& reduced() const { return reduced_; }
  /// Whether the last linearisation is at u, under the present sensor noise and with the present kind of
  /// slopes.
  bool stands_at(const Eigen::VectorXd& u) const { return stands_ && u == trial_u_; }
  /// Whether it was made with leverages, so that moments() may be called.
  bool has_leverages_at(const Eigen::VectorXd& u) const { return leverages_ && stands_at(u); }
  /// Accepts the last linearisation: states are predicted from it from now on.
  void accept();
  /// Moves the states to their optimum for u and accepts. Takes up to `rounds` Gauss-Newton steps; ends
  /// earlier where the next one would change the cost by less than the share `enough`, or where several steps
  /// brought no decrease.
  void settle(const Eigen::VectorXd& u, int rounds = 2, double enough = 1e-4);
  /// The same, converged only as far as arc_ends() needs, which takes the last step itself.
  void settle_ends(const Eigen::VectorXd& u, int rounds, double enough);

  /// Takes over the states of a smoother with the same chunks.
  void set_states(const std::vector<FlightState<double>>& states) {
    states_ = states;
    set_axes();
  }

  /// Takes over the states of a smoother of the same record with other chunks: they are simulated on to where
  /// the chunks begin here.
  void start_from(const FlightSmoother& other);

  /// Sets another noise model and keeps the states. After a change of the axes of gusts the next
  /// linearisation has no leverages yet.
  void set_noise(const NoiseModel& noise);
  /// Slopes in double precision and fine steps from now on, for data that are exact to the last digit.
  void set_exact(bool exact) {
    stands_ = stands_ && exact == exact_, exact_ = exact;
    if (exact) set_steps(Steps::fine);
  }
  void set_steps(Steps steps) { stands_ = stands_ && steps == by_, by_ = steps; }
  Steps steps() const { return by_; }
  /// What fine steps would change at the accepted states, as sums of squares.
  struct WorthOfSteps {
    double rows = 0;   ///< difference of the weighted residuals
    double links = 0;  ///< noise of motors and gusts that would bring about the differences where chunks end
  };
  WorthOfSteps worth_of_fine_steps();
  /// Shortens steps of states from which the simulation diverges. Without it the cost is not finite there.
  void set_gentle(bool gentle) { gentle_ = gentle; }
  double huber() const { return huber_; }
  /// Residuals beyond this many standard deviations count linearly.
  void set_huber(double huber) { stands_ = stands_ && huber == huber_, huber_ = huber; }

  /// Moments of the residuals of the last linearisation, which must have been made with leverages.
  Moments moments() const;
  /// Maximum likelihood estimate of the process noise for the last linearisation (`rounds` steps of
  /// expectation maximisation). Eliminates the states under it if asked to. Returns the largest relative
  /// change of a standard deviation.
  double retune(int rounds, bool eliminated = true);
  /// Minus twice the log marginal likelihood of the noise: states integrated out, shared unknowns at their
  /// optimum, by the last elimination. A constant that depends on the measurements only is left out.
  double surprise() const;
  /// Calls work(0) to work(count - 1), on all threads.
  void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) const;
  /// Adds shared unknowns after theta: amplitudes of given profiles of the acceleration from outside,
  /// [chunk](6 x count) over (w_dot_B, v_dot_W). An empty list removes them.
  void set_profiles(std::vector<Eigen::MatrixXd> profiles) {
    profiles_ = std::move(profiles), eliminated_ = linearised_.stands = false;
  }
  /// Cuts all links: every chunk then starts from a state of its own.
  void unlink();

  /// Scores and information of blocks of about `seconds`, states projected out, at the accepted
  /// linearisation.
  std::vector<ScoreBlock> score_blocks(double seconds) const;

  /// Derivative of the weighted residuals [chunk][row][kChannels] (by differences) and of the defects of the
  /// links [chunk] along a step of the shared unknowns, with the states following. At the accepted
  /// linearisation.
  struct Along {
    std::vector<std::vector<double>> residuals, residual_slopes;
    std::vector<Eigen::VectorXd> defects, defect_slopes, weights;
  };
  Along along(const Eigen::VectorXd& du);

  /// State at the last row of each arc from all data before it, with its covariance, at the accepted
  /// linearisation.
  struct End {
    FlightState<double> x;
    Eigen::MatrixXd P;
  };
  std::vector<End> arc_ends();

  /// The accepted states, and the weighted residuals [row][kChannels] of each chunk there.
  const std::vector<FlightState<double>>& states() const { return states_; }
  std::vector<std::vector<double>> residuals();
  /// Variance of the acceleration from outside in chunk k that the error of the input causes. Axis 0 to 2:
  /// about the body axes; 3 to 5: along the axes of the gusts; -1: none.
  double input_error(std::size_t k, int axis) const;
  /// Defect of each link at the accepted states, after `residuals()`. Empty where there is no link.
  std::vector<Eigen::VectorXd> defects() const;

 private:
  // Linked chunks. Their two ends are eliminated towards `meet`, which is the last chunk of a short chain.
  struct Chain {
    std::size_t begin = 0, meet = 0, end = 0;
  };
  static Chain chain_of(std::size_t begin, std::size_t end);

  // The step of x_k is -(f_k + B_k du) - G_k dx_next, where `next` is its neighbour towards the meeting
  // point. L L' is the information on x_k from its own end of the chain, with the shared unknowns held. Gt is
  // G transposed, its rows padded.
  struct Elimination {
    std::vector<chunk::RowMatrix> B, Gt, L;
    std::vector<Eigen::VectorXd> f;
    bool held = false;  // shared unknowns held: no B
  };

  // P: covariance of x_k from its whole chain, by one elimination, with the shared unknowns held. `cross`:
  // covariance of x_(k+1) with x_k. Rows are padded.
  struct Covariances {
    std::vector<chunk::RowMatrix> P, cross;
    std::optional<std::size_t> of;  // index of the elimination
  };

  // What all eliminations of one linearisation share.
  struct Linearised {
    bool stands = false;
    std::vector<chunk::RowMatrix> E;  // slopes of each link over its state and, from padded(n) on, the shared
    std::vector<Eigen::MatrixXd> S;   // of each chain: J'J of what the rows say of theta, upper half,
    std::vector<Eigen::VectorXd> g;   // and J'r
    Eigen::VectorXd held;             // step of theta that is held,
    std::vector<Eigen::VectorXd> f, d;  // and what it adds to the gradient and the defect of each chunk
  };

  struct Sweep;
  struct LinkMoments;  // of all process noise, over the links
  struct NoisePaces;

  // Three components of the state that follow a Gauss-Markov process from chunk to chunk. At -1 the state has
  // none of them.
  struct Process {
    int at = -1;
    const std::array<ColouredNoise, 3>* noise = nullptr;
    int first_input = -1;  // axis of input_error() of the first component; -1: not affected by the input
    double least = 0.0;    // variance, where there is no such noise

    const ColouredNoise& axis(int i) const { return (*noise)[static_cast<std::size_t>(i)]; }
    int input_axis(int i) const { return first_input < 0 ? -1 : first_input + i; }
  };
  std::array<Process, 2 + kShownGroups> processes(std::size_t k) const;

  ChunkTask task(std::size_t k, const Eigen::VectorXd& u, const std::vector<double>& p,
                 const std::vector<std::vector<Seed>>& seeds) const;
  void predict(const Eigen::VectorXd& u);
  void evaluate(const Eigen::VectorXd& u, bool jacobian, bool leverage);
  void evaluate(const Eigen::VectorXd& u, bool jacobian, bool leverage,
                const std::vector<std::size_t>& chunks);
  void settle_until(const Eigen::VectorXd& u, int rounds, double enough,
                    const std::function<double(double fall, double before)>& left);
  void shorten_wild_steps(const Eigen::VectorXd& u, bool leverage);
  void eliminate(const Eigen::VectorXd* held = nullptr);
  Eigen::VectorXd defect(std::size_t k) const;
  Eigen::VectorXd link_weight(std::size_t k) const;
  Eigen::VectorXd carried(std::size_t k) const;
  Eigen::VectorXd unseen_in(const FlightArc& arc) const;
  Eigen::VectorXd start_information(std::size_t k) const;
  Eigen::MatrixXd start_slope(std::size_t k) const;
  struct SpeedScale {
    int slot;
    double share;
  };
  std::optional<SpeedScale> scale_of_speeds() const;
  const AirNoise& air_of(std::size_t k) const;
  Eigen::VectorXd outside(std::size_t k) const;
  double new_error(std::size_t k, int axis, double carried) const;
  LinkMoments link_moments(const Eigen::VectorXd& du);
  double update_noise(const LinkMoments& moments, NoisePaces& paces);
  double noise_that_makes(const std::vector<Eigen::VectorXd>& defects) const;
  Eigen::Index shared() const;
  Eigen::MatrixXd profile(std::size_t k) const;
  void begin_eliminations();
  void hold(const Eigen::VectorXd& du);
  chunk::RowMatrix link_slope(std::size_t k) const;
  void set_shares(std::size_t k, chunk::RowMatrix& E) const;
  static void damp_undetermined(chunk::RowMatrix& D, int n);
  void add_start(std::size_t k, Sweep& at, bool held) const;
  void add_rows(std::size_t k, Sweep& at, bool held) const;
  void add_link(std::size_t k, Sweep& at, bool forward, bool held);
  void eliminate_chunk(std::size_t k, Sweep& at, bool linked);
  std::unique_ptr<Sweep> sweep(const Chain& chain, bool forward, bool held);
  void outward(const std::function<void(std::size_t, std::optional<std::size_t>)>& visit) const;
  Eigen::VectorXd shared_optimum() const;
  std::vector<Eigen::VectorXd> state_steps(const Elimination& el, const Eigen::VectorXd& du) const;
  std::vector<chunk::RowMatrix> state_slopes() const;
  FlightState<double> moved(const FlightState<double>& x, const Eigen::VectorXd& dx) const;
  void set_axes();
  void set_input_errors();
  chunk::RowMatrix own_covariance(const Elimination& el, std::size_t k) const;
  const Covariances& covariances_by(std::size_t elimination);
  Elimination& accepted() { return eliminations_[accepted_at_]; }
  const Elimination& accepted() const { return eliminations_[accepted_at_]; }
  Elimination& last() { return eliminations_[last_at_]; }
  const Elimination& last() const { return eliminations_[last_at_]; }

  const FlightRecord* record_;
  const Theta* theta_;
  NoiseModel noise_;
  double chunk_seconds_;
  int threads_;
  double huber_ = 4.0;
  Steps by_ = Steps::fine;  // kind of integration steps
  bool stands_ = false, leverages_ = false, exact_ = false, gentle_ = false;
  bool eliminated_ = false;  // the last linearisation, under the present noise, shared unknowns free
  std::vector<ChunkPlace> places_;
  std::vector<Chain> chains_;
  std::vector<Eigen::VectorXd> unseen_;              // unseen_in() of each arc
  std::vector<FlightState<double>> states_, trial_;  // accepted, and those of the last linearisation
  std::vector<Eigen::VectorXd> steps_;               // from the one to the other
  std::vector<ChunkResult> results_;
  Linearised linearised_;
  std::vector<Eigen::MatrixXd> profiles_;
  std::vector<AccelerationVariance> input_errors_;  // of each chunk; empty where the input has none
  Eigen::VectorXd u_, trial_u_;                     // of the accepted and of the last linearisation
  // The accepted elimination and the last one. They are the same from accept() to the next eliminate().
  std::array<Elimination, 2> eliminations_;
  std::size_t accepted_at_ = 0, last_at_ = 0;
  Covariances covariances_;  // the largest member: one copy only
  ReducedSystem reduced_;
};

}  // namespace ident
