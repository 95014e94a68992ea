// What a model misses over windows of measured flight: its forces, its moments and its rotors apart.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "ident/flight/ladder/measured_motion.h"
#include "ident/flight/ladder/model_along.h"

namespace ident {

/// Which side is looked at: one of those of (1) in window_fit.h, or the speeds of the rotors for their
/// commands.
enum class FitTo { forces, moments, speeds };

/// Windows over which that side is compared: long enough that what filters of a log's makers take away does
/// not matter, short enough that little is turned back within one.
std::vector<Window> windows_of(const MeasuredMotion& motion, FitTo what);

/// Length of those windows, s.
double horizon_of(FitTo what);

/// What was measured beyond what the model gives, three components a window: m/s in the world, or rad/s of
/// the body. Of forces or of moments.
Eigen::VectorXd missed_in(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
                          const std::vector<ModelAlong>& model);

/// The same of any side for constants `p`. Of speeds one component for each rotor, rad/s: the mean over the
/// window, 0 where none was measured.
Eigen::VectorXd missed_by(const MeasuredMotion& motion, const std::vector<Window>& windows, FitTo what,
                          std::span<const double> p);

/// Errors that speeds for their commands have beside the equation of a motor, as residuals: a command curve
/// that bends by a hundredth of full speed (a bench calls no curve bent before that: command_curve_bent), and
/// speeds that drift by a hundredth along the flight, as magnets and windings get warm.
std::vector<Eigen::VectorXd> usual_errors_of_speeds(const MeasuredMotion& motion,
                                                    const std::vector<Window>& windows,
                                                    std::span<const double> p);

/// Of moments, what those windows would miss more if rates were measured a second later than they were, by
/// the angular acceleration of the model, rad/s.
Eigen::VectorXd missed_by_late_rates(const MeasuredMotion& motion, const std::vector<Window>& windows,
                                     const std::vector<ModelAlong>& model);

}  // namespace ident
