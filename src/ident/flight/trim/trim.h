// What a flight tells without a record of how the vehicle turned: over some seconds it neither tumbles nor
// flies off, so that what its rotors are commanded to do balances. Four numbers of each stretch, thrust and
// three moments, and what constants and effects make of them.
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ident/flight/fit/fit.h"
#include "ident/result/result.h"

namespace ident {

constexpr int kTrimChannels = 4;  ///< thrust, moments about x, y, z

/// s of a stretch, at least: motors and corrections average out.
constexpr double kShortestStretch = 2.0;

/// From flight to flight the rotors of a vehicle that nobody touched scatter by some two per cent; a factor
/// of e more or less is nothing unusual. The flights themselves decide where there are several.
constexpr double kUsualScatter = 0.02;
/// And by this what all of them thrust for a command, by the state of the battery.
constexpr double kUsualLevel = 0.03;

/// Standard deviations from flight to flight, relative, of thrust for the same command.
struct TrimScatter {
  double rotor = 0.0;  ///< of each rotor by itself
  double level = 0.0;  ///< of all together
};

/// Some seconds of flight, after take-off and before landing.
struct TrimStretch {
  int log = 0, arc = 0;
  std::size_t begin = 0, end = 0;  ///< rows of the arc
  double t = 0.0;                  ///< s, its middle
  double needed = 0.0;             ///< specific force that the path asks for, m/s^2
};

/// The stretches of all logs and how their unbalance is counted: thrust over what is needed less 1, moments
/// over thrust times `reach`.
struct Trim {
  std::vector<TrimStretch> stretches;
  double weight = 0.0, reach = 0.0;  ///< N, m
  double drag = 0.0;                 ///< kQ/kT as stated, m: the moment about z is in units of it
  int logs = 0;                      ///< that have a stretch

  Eigen::Index rows() const { return kTrimChannels * static_cast<Eigen::Index>(stretches.size()); }
};

/// A linear fit of the shared unknowns to the balance. Only u and the covariances of `fit` are set.
struct TrimFit {
  FlightFit fit;
  Eigen::VectorXd y;  ///< unbalance at the fit, [stretch][channel]
  Eigen::MatrixXd V;  ///< covariance of y where the model is right, scatter from flight to flight included
  Eigen::Vector4d noise;  ///< standard deviation of a stretch about the mean of its log
  TrimScatter scatter;
  double beyond = 0.0;  ///< cost of what logs differ by from the model and what is known of it, chi2 of
                        ///< kTrimChannels for each log
};

/// Whether logs hold neither rates nor attitude, and yet what balance needs: what the rotors do, and a path.
bool only_trim(const Signals& logged);

/// Throws DataError where no log flies long enough. `p`: constants as stated.
Trim make_trim(const FlightRecord& record, const std::vector<double>& p);

/// Unbalance of all stretches with these constants, [stretch][channel].
Eigen::VectorXd unbalance(const FlightRecord& record, const Trim& trim, const std::vector<double>& p);

/// Derivative of the unbalance over the constants of `theta` at u.
Eigen::MatrixXd trim_slopes(const FlightRecord& record, const Trim& trim, const Theta& theta,
                            const Eigen::VectorXd& u);

/// The constants that balance may tell: those of a refinement, and the thrust of each rotor relative to the
/// others as effect `rotor_mismatch`, equal to some 10 % where nothing is stated.
std::vector<FreeConstant> trim_constants(const FlightRecord& record, const std::vector<double>& p,
                                         std::vector<std::string> also = {});

/// The name of the thrust of rotor k, from 1, relative to what is stated; and whether a name is such a one.
inline constexpr std::string_view kRotorRatio = "rotor_mismatch.ratio@";
inline std::string rotor_ratio(std::size_t k) { return std::string(kRotorRatio) + std::to_string(k); }
inline bool is_rotor_ratio(std::string_view name) { return name.starts_with(kRotorRatio); }

/// Whether the vehicle file says what thrust each rotor has, as a refinement by balance leaves it.
bool states_rotor_ratios(const Vehicle& vehicle);

}  // namespace ident
