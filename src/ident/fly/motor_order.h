// Which rotor of a vehicle an autopilot's motor output drives: by where rotors sit and how they spin.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ident/io/geometry/frame_geometry.h"

namespace ident {

/// Rotor (from 0) that each output drives, output 1 first; and a sentence that says so.
struct MotorOrder {
  std::vector<std::size_t> rotor_of_output;
  std::string note;
};

/// The rotor on each arm of a frame: within 12 degrees of its direction, and of its spin as
/// yaw feels it. Empty where an arm
/// has no rotor of its own.
std::optional<std::vector<std::size_t>> rotors_on_frame(const Vehicle& vehicle,
                                                        std::span<const FrameArm> arms);

/// An order that the user gives, rotor numbers from 1, output 1 first. Throws UsageError where it is no
/// permutation of the vehicle's rotors.
MotorOrder given_order(const Vehicle& vehicle, std::span<const int> numbers);

/// "output 1 drives rotor 1, output 2 rotor 3": an order in words.
std::string order_in_words(std::span<const std::size_t> rotor_of_output);

/// "rotor 1 at 45 deg, counter-clockwise; ...": what a frame has to have, for messages.
std::string rotors_in_words(const Vehicle& vehicle);

}  // namespace ident
