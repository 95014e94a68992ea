// The model that a vehicle or parameter file states, read for prediction by the scorer.
#pragma once

#include <Eigen/Dense>
#include <map>
#include <string>
#include <vector>

namespace field {

struct StatedModel {
  double m = 0, gravity = 9.81, battery_voltage = 0, command_min = 0, command_max = 1;
  std::vector<Eigen::Vector3d> hubs;
  std::vector<double> spins;                // +1 counter-clockwise from above
  std::map<std::string, double> constants;  // under `parameters`, by name
  double get(const std::string& name, double otherwise = 0) const;
  bool has(const std::string& name) const { return constants.contains(name); }
};

StatedModel read_model(const std::string& vehicle_file);
// What the second file states wins.
StatedModel overlay(StatedModel model, const std::string& parameter_file);

}  // namespace field
