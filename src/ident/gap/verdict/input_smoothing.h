// What a diagnosis owes to measured rotor speeds as its input: their noise cannot be taken off without taking
// some of the motion.
#pragma once

#include <string>
#include <vector>

#include "ident/gap/hypotheses/fitted_model.h"
#include "ident/gap/verdict/verdict.h"

namespace ident {

/// The causes found whose size depends on how the speeds were smoothed; `moved` is how far the unknowns move
/// with the other smoothing, and is not in the model's covariance yet.
std::vector<std::string> depend_on_smoothing(const FittedModel& model, const Eigen::VectorXd& moved);

/// How many times the size that would have been seen a cause has to have where measured speeds are the input:
/// more where motors are over with a change before some rows have passed, and no row shows how.
double least_size(const FlightRecord& record);

/// What a model misses half a second ahead of held-out flight with its constants fitted to the training part.
double refitted_error(const FittedModel& model, const FlightRecord& record, const FlightRecord& held_out,
                      const NoiseModel& noise, PredictionOptions options);

/// A verdict by measured speeds. None is named where one of those named is among the `loose` ones, as the
/// rest was found beside it, nor where held-out flight is predicted no better with them: noise in an input
/// makes a vehicle seem to respond less. Those that are `small`, by least_size(), are not named where the
/// constants alone, refitted, miss held-out flight by no more than the noise, `without`: what speeds do
/// between their samples is as large. What is unknown may all be noise.
Judged with_noisy_input(Judged verdict, const std::vector<std::string>& loose,
                        const std::vector<std::string>& small, const GapClosed& gap, double without);

/// The verdict on logs whose rotors jump as no command says: where nothing explains them, that may be why.
Judged with_jitter(Judged verdict);

}  // namespace ident
