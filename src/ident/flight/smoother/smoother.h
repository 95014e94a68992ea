// Chains of chunks, one for each arc: evaluates them on all cores, links them, and eliminates their states in
// time order, of long chains from both ends.
//
//   cost = sum_chunks rho(r_k(x_k, theta)^2) + sum_links d_k' W_k d_k ,   d_k = end(x_k, theta) - x_(k+1)
//
// The state holds accelerations from outside, and slow errors of what is shown, that are constant over a
// chunk and follow a Gauss-Markov process from one to the next; all else continues without a jump. No such
// noise makes one long output-error fit, infinite noise unlinked segments. The states are a block tridiagonal
// system with a border of shared unknowns; elimination costs O(length).
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

/// Where a chunk lies.
struct ChunkPlace {
  int arc = 0;
  std::size_t begin = 0, end = 0;
  bool linked = false;  ///< to the next one
};

/// Normal equations of the shared unknowns after elimination: cost(u + du) ~ cost + 2 g'du + du'S du.
struct ReducedSystem {
  double cost = 0.0;  ///< at the best states for u, to second order
  double fall = 0.0;  ///< to that from the cost of the states as they are
  Eigen::VectorXd g;
  Eigen::MatrixXd S;
  double log_det = 0.0;  ///< of the states' information, over that of the links and of what precedes an arc
};

/// Per channel: squared weighted residuals, what the states took from them, and samples.
struct Moments {
  std::array<double, kChannels> square{}, leverage{}, count{};
};

/// Gradient and information of a stretch of flight: they add up to those of the reduced system.
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

  /// Linearises at u and the states predicted for it, and eliminates the states. Priors are not in it.
  /// With `leverage` moments() can be asked for afterwards.
  const ReducedSystem& linearize(const Eigen::VectorXd& u, bool leverage = false);
  /// Eliminates the last linearisation once more, after a change of the process noise.
  const ReducedSystem& relinearize();
  /// What the last linearisation would say of each constant, were all states known.
  Eigen::VectorXd information_of_held_states() const;
  /// What the last elimination left.
  const ReducedSystem& reduced() const { return reduced_; }
  /// Whether the last linearisation is at u, of the present sensor noise and kind of slopes.
  bool stands_at(const Eigen::VectorXd& u) const { return stands_ && u == trial_u_; }
  /// Makes the last linearisation the one from which states are predicted from now on.
  void accept();
  /// Moves the states to their best for u (`rounds` Gauss-Newton steps, fewer where the next one would change
  /// less than that share of the cost, or the last ones did) and accepts.
  void settle(const Eigen::VectorXd& u, int rounds = 2, double enough = 1e-4);
  /// The same for arc_ends() only, which take the last step themselves.
  void settle_ends(const Eigen::VectorXd& u, int rounds, double enough);

  /// Takes over states, from a smoother with the same chunks.
  void set_states(const std::vector<FlightState<double>>& states) {
    states_ = states;
    set_axes();
  }

  /// Takes over the states of a smoother of the same record, simulated on to where chunks begin here.
  void start_from(const FlightSmoother& other);

  /// Another noise model; the states stay. After a change of axes the next linearisation has no leverage yet.
  void set_noise(const NoiseModel& noise);
  /// Slopes in double precision, for a fit to the last digit of exact data, and fine steps from then on.
  void set_exact(bool exact) {
    stands_ = stands_ && exact == exact_, exact_ = exact;
    if (exact) set_steps(Steps::fine);
  }
  void set_steps(Steps steps) { stands_ = stands_ && steps == by_, by_ = steps; }
  Steps steps() const { return by_; }
  /// What fine steps would change at the accepted states, squared and summed.
  struct WorthOfSteps {
    double rows = 0;   ///< differences of weighted residuals
    double links = 0;  ///< noise of motors and gusts that would bring about the differences where chunks end
  };
  WorthOfSteps worth_of_fine_steps();
  /// Steps of states from which nothing flies are shortened. Without, the cost there is no number.
  void set_gentle(bool gentle) { gentle_ = gentle; }
  double huber() const { return huber_; }
  /// Residuals beyond this many standard deviations count linearly.
  void set_huber(double huber) { stands_ = stands_ && huber == huber_, huber_ = huber; }

  /// Residual moments of the last linearisation, which was asked for leverages.
  Moments moments() const;
  /// Process noise that makes the last linearisation most likely (expectation maximisation, `rounds` steps),
  /// and the states eliminated under it if asked for; gives the largest relative change of a standard
  /// deviation.
  double retune(int rounds, bool eliminated = true);
  /// Minus twice the log likelihood of the noise, states integrated out and shared unknowns at their optimum,
  /// by the last elimination; without the constant that only the measurements set.
  double surprise() const;
  /// Calls `work` for 0 to count - 1 on all threads.
  void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) const;
  /// Further shared unknowns, after theta in the reduced system: accelerations from outside that follow given
  /// profiles, [chunk](6 x count) over (w_dot_B, v_dot_W). None with an empty list.
  void set_profiles(std::vector<Eigen::MatrixXd> profiles) {
    profiles_ = std::move(profiles), eliminated_ = linearised_.stands = false;
  }
  /// Cuts all links: every chunk starts afresh.
  void unlink();

  /// What blocks of about `seconds` say of the shared unknowns, states projected out, at the accepted
  /// linearisation.
  std::vector<ScoreBlock> score_blocks(double seconds) const;

  /// How weighted residuals [chunk][row][kChannels] (by differences) and defects of the links [chunk] at the
  /// accepted linearisation change with a step of the shared unknowns, the states following.
  struct Along {
    std::vector<std::vector<double>> residuals, residual_slopes;
    std::vector<Eigen::VectorXd> defects, defect_slopes, weights;
  };
  Along along(const Eigen::VectorXd& du);

  /// State at the last row of each arc, from all data before it, with its covariance, by the accepted
  /// linearisation.
  struct End {
    FlightState<double> x;
    Eigen::MatrixXd P;
  };
  std::vector<End> arc_ends();

  /// The accepted states, and weighted residuals [row][kChannels] of each chunk there.
  const std::vector<FlightState<double>>& states() const { return states_; }
  std::vector<std::vector<double>> residuals();
  /// Variance of the accelerations from outside in chunk k by the error of its input: about the axes of the
  /// body, then along those of the noise; none for axis -1.
  double input_error(std::size_t k, int axis) const;
  /// Defect of each link at the accepted states, after `residuals()`; empty where there is no link.
  std::vector<Eigen::VectorXd> defects() const;

 private:
  // Linked chunks, eliminated from both ends to where they meet: the last one if they are few.
  struct Chain {
    std::size_t begin = 0, meet = 0, end = 0;
  };
  static Chain chain_of(std::size_t begin, std::size_t end);

  // x_k moves by -(f_k + B_k du) - G_k dx_next, with the chunk next to it towards where the ends meet. L L'
  // is the information on x_k from its own end of the chain, shared unknowns held. Gt is G transposed, its
  // rows padded.
  struct Elimination {
    std::vector<chunk::RowMatrix> B, Gt, L;
    std::vector<Eigen::VectorXd> f;
    bool held = false;  // shared unknowns held: no B
  };

  // P of x_k from all of its chain, by one elimination, `cross` of x_(k+1) and x_k; shared unknowns held,
  // rows padded.
  struct Covariances {
    std::vector<chunk::RowMatrix> P, cross;
    std::optional<std::size_t> of;  // place of the elimination
  };

  // What is the same in each elimination of a linearisation.
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

  // Three components of the state that follow a Gauss-Markov process from chunk to chunk; at -1 there are
  // none.
  struct Process {
    int at = -1;
    const std::array<ColouredNoise, 3>* noise = nullptr;
    int first_input = -1;  // axis of input_error() of the first one; -1: the input has nothing to do with it
    double least = 0.0;    // variance that stands for none

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
  Steps by_ = Steps::fine;  // which flight is simulated
  bool stands_ = false, exact_ = false, gentle_ = false;
  bool eliminated_ = false;  // the last linearisation, under the present noise, shared unknowns free
  std::vector<ChunkPlace> places_;
  std::vector<Chain> chains_;
  std::vector<Eigen::VectorXd> unseen_;              // unseen_in() each arc
  std::vector<FlightState<double>> states_, trial_;  // accepted, and those of the last linearisation
  std::vector<Eigen::VectorXd> steps_;               // from the one to the other
  std::vector<ChunkResult> results_;
  Linearised linearised_;
  std::vector<Eigen::MatrixXd> profiles_;
  std::vector<AccelerationVariance> input_errors_;  // of each chunk; empty where the input has none
  Eigen::VectorXd u_, trial_u_;                     // of the accepted and of the last linearisation
  // The accepted elimination and the last one; the same one from accept() to the next eliminate().
  std::array<Elimination, 2> eliminations_;
  std::size_t accepted_at_ = 0, last_at_ = 0;
  Covariances covariances_;  // the largest thing here: kept once
  ReducedSystem reduced_;
};

}  // namespace ident
