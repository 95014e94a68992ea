// Residuals of a short piece of flight with their derivatives, condensed into normal equations: the inner
// loop.
//
// A chunk is a run of rows of one log that starts from a free state x0. It is simulated with the flight
// model, its measurements give weighted residuals r, and with J = dr/d(x0, theta) the kernel returns J'J,
// J'r, the cost, and the state at the chunk's end with its derivative, by which chunks are linked.
// Derivatives come from dual numbers that run through the one templated model. The same source is compiled
// for several instruction sets (Isa); the best that the machine has is chosen at run time.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "ident/effects/catalogue.h"
#include "ident/model/flight.h"

namespace ident {

/// Measurement channels; the rotor speeds follow at `kRotorChannel`.
enum Channel : int {
  kGyro = 0,
  kForce = 3,
  kAttitude = 6,
  kVelocity = 9,
  kPosition = 12,
  kRotorChannel = 15
};
constexpr int kChannels = kRotorChannel + kMaxRotors;

/// Which parts of the state are free, and their places in the local vector; -1: not part of the problem.
struct StateLayout {
  int rotors = 0;                                ///< of the vehicle
  int w = 0, attitude = -1, v = -1, x = -1;      ///< three components each
  int motors = -1;                               ///< Omega of all rotors, then their rates
  int w_dot = -1, v_dot = -1;                    ///< accelerations from outside, three components each
  int shown_error[kShownGroups] = {-1, -1, -1};  ///< slow errors of what is shown, three components each
  int size = 3;
};

/// One element of d(model constant)/d(theta). Slots from kParameterCount on are the gyro bias.
struct Seed {
  int slot = 0, direction = 0;
  double derivative = 0.0;
  EffectMask effect = 0;  ///< the effect that the constant belongs to
};

/// Integration steps: Runge-Kutta 4 from row to row; order 2 from row to row, at half the cost; order 2 over
/// several rows, as long as the motors allow.
enum class Steps { fine, coarse, longest };

struct ChunkTask {
  const Vehicle* vehicle = nullptr;
  const FlightInputs* inputs = nullptr;
  StateLayout layout;
  std::span<const double> p;          ///< the model's constants
  std::array<double, 3> gyro_bias{};  ///< rad/s
  std::span<const Seed> seeds;
  EffectMask active = 0;  ///< effects off their null values
  int thetas = 0;
  std::size_t begin = 0, end = 0;  ///< rows [begin, end); simulated to row `end`
  std::size_t rows = 0;            ///< number of rows of the whole arc
  const double* t = nullptr;       ///< times of the whole arc, s
  const double* y = nullptr;       ///< [row][kChannels]; attitude channels hold 0 or NaN for "not sampled"
  const double* q = nullptr;       ///< [row][4] measured attitude
  const double* weight = nullptr;  ///< [kChannels] 1/sigma
  double huber = 4.0;              ///< residuals beyond this many sigma count linearly
  double shift = 0.0;              ///< delay of rates and attitude about which the model is linearised, s
  FlightState<double> x0;
  bool jacobian = true;
  bool products = true;                ///< J'J too; without, leverages only
  bool few_leverages = false;          ///< leverages of every third sample stand for those of its neighbours
  bool exact = false;                  ///< derivatives in double precision, at twice the cost
  const double* covariance = nullptr;  ///< of the local state, to compute leverages; or nullptr
  Steps steps = Steps::fine;
  double max_step = kEstimatorStep;  ///< s; longer steps between rows are split
};

struct ChunkResult {
  double cost = 0.0;         ///< sum of rho(r^2), twice the usual half
  std::vector<double> A, g;  ///< d x d (row major, whole) and d; d = layout.size + thetas
  std::vector<double> E;     ///< layout.size x d: derivative of the end state
  FlightState<double> x_end;
  std::array<double, kChannels> square{}, leverage{},
      count{};  ///< per channel: sum r^2 (clipped), leverages, samples
  std::vector<double>
      residuals;  ///< [row][kChannels], weighted; NaN where not sampled; filled without jacobian
};

/// Evaluates one chunk with the best instruction set of this machine.
void evaluate_chunk(const ChunkTask& task, ChunkResult& result);

/// The same by name, for tests and the benchmark: baseline, avx2, avx512. False when the machine lacks it.
bool evaluate_chunk_with(std::string_view isa, const ChunkTask& task, ChunkResult& result);

}  // namespace ident
