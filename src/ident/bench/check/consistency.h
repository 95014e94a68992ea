// Is what a vehicle file states physically possible, and can it fly?
#pragma once

#include <string>
#include <vector>

#include "ident/model/vehicle.h"
#include "ident/result/result.h"

namespace ident {

/// A statement that no real vehicle can meet, with the numbers it was judged by.
struct Violation {
  std::string code;
  std::string message;
  nlohmann::ordered_json values;
};

/// What one check has to say. `findings` are in plain words, one for each thing that was looked at.
struct Finding {
  std::string what;     ///< "triangle inequality"
  std::string verdict;  ///< "ok", "violated", "doubtful", "cannot be judged"
  std::string numbers;
};

/// Collects what the checks find.
struct Consistency {
  std::vector<Violation> violations;
  std::vector<Warning> warnings;
  std::vector<Finding> findings;
  nlohmann::ordered_json extra = nlohmann::ordered_json::object();

  void ok(std::string what, std::string numbers);
  void violated(std::string what, Violation violation);
  void doubtful(std::string what, Warning warning);
  void cannot_be_judged(std::string what, const std::string& missing);
};

// The checks, each on its own subject.

/// All of them. `extra` has `violations`, `thrust_to_weight`, `hover_command`, `hover_rotor_speed`; null
/// where the file does not say enough.
Result check_consistency(const Vehicle& vehicle);

}  // namespace ident
