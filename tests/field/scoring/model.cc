// Reads constants and effects of a YAML file.
#include "model.h"

#include <yaml-cpp/yaml.h>

namespace field {
namespace {

double value_of(const YAML::Node& node) {
  return node.IsMap() ? node["value"].as<double>() : node.as<double>();
}

bool is_number(const YAML::Node& node) {
  try {
    (void)value_of(node);
    return true;
  } catch (const YAML::Exception&) {
    return false;
  }
}

void take(StatedModel& model, const YAML::Node& file) {
  if (file["gravity"]) model.gravity = value_of(file["gravity"]);
  if (file["mass"]) model.m = value_of(file["mass"]);
  if (file["battery_voltage"]) model.battery_voltage = value_of(file["battery_voltage"]);
  if (file["command"]) {
    model.command_min = file["command"]["min"].as<double>();
    model.command_max = file["command"]["max"].as<double>();
  }
  if (file["rotors"]) {
    model.hubs.clear();
    model.spins.clear();
    for (const auto& rotor : file["rotors"]) {
      const auto r = rotor["position"].as<std::vector<double>>();
      model.hubs.emplace_back(r[0], r[1], r[2]);
      model.spins.push_back(rotor["spin"].as<std::string>() == "ccw" ? 1 : -1);
    }
  }
  for (const auto& entry : file["parameters"]) {
    const auto name = entry.first.as<std::string>();
    if (!is_number(entry.second)) continue;
    if (name == "m") {
      model.m = value_of(entry.second);
    } else {
      model.constants[name] = value_of(entry.second);
    }
  }
}

}  // namespace

double StatedModel::get(const std::string& name, double otherwise) const {
  const auto at = constants.find(name);
  return at == constants.end() ? otherwise : at->second;
}

StatedModel read_model(const std::string& vehicle_file) { return overlay({}, vehicle_file); }

StatedModel overlay(StatedModel model, const std::string& parameter_file) {
  take(model, YAML::LoadFile(parameter_file));
  return model;
}

}  // namespace field
