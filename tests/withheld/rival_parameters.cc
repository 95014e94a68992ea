// The list of the rival's parameters and causes.
#include <cmath>

#include "rival_model.h"

namespace rival {

int Model::add(const std::string& name, double step, double null, double prior) {
  const int index = static_cast<int>(parameters_.size());
  parameters_.push_back({name, null, step, prior});
  index_[name] = index;
  return index;
}

void Model::list_parameters() {
  const double m = vehicle_.value.at("m"), kd = 0.3 * m / (4 * hover_);
  const double arm = vehicle_.rotors[0].r.norm(), J = vehicle_.value.at("Jxx");
  for (const auto& [name, value] : vehicle_.value) {
    const int index = add(name, 0.01 * value, value, vehicle_.std.at(name));
    causes_.push_back({"parameter:" + name, {index}});
  }
  for (std::size_t log = 0; log < logs_.size(); ++log) {
    for (const char* axis : {"p", "q", "r"})
      add(std::string("bias_") + axis + std::to_string(log), 1e-3, 0, 0.02);
  }
  const auto cause = [&](const std::string& effect,
                         const std::vector<std::pair<std::string, double>>& steps) {
    Cause c{effect, {}};
    for (const auto& [name, step] : steps) c.parameters.push_back(add(effect + "." + name, step));
    causes_.push_back(c);
    return c.parameters.front();
  };
  const int drag = cause("rotor_drag", {{"kd", 0.1 * kd}});
  cause("parasitic_drag", {{"C", 1e-3}});
  cause("translational_lift", {{"kh", 1e-3 * m}});
  cause("axial_inflow", {{"kz", 0.1 * kd}});
  cause("blade_flapping", {{"kf", 0.1 * kd * vehicle_.radius}});
  cause("ground_effect", {{"radius2", 0.1 * vehicle_.radius * vehicle_.radius}});
  cause("wind", {{"north", 0.2}, {"east", 0.2}, {"down", 0.2}});
  causes_.back().parameters.push_back(drag);
  cause("battery_sag", {{"n", 0.05}});
  cause("motor_delay", {{"tau", 2e-3}});
  cause("sensor_delay", {{"tau", 2e-3}});
  cause("motor_asymmetry", {{"slow", 0.05}});
  cause("thrust_curve", {{"c", 0.02}});
  cause("gyroscopic", {{"Jp", 1e-3 * J}});
  for (int rotor = 1; rotor <= 4; ++rotor) {
    const std::string number = std::to_string(rotor);
    const Cause weak{"rotor_mismatch", {add("rotor_mismatch.weak" + number, 0.01)}, rotor};
    const int about_x = add("rotor_tilt.x" + number, 0.01), about_y = add("rotor_tilt.y" + number, 0.01);
    const Cause tilt{"rotor_tilt", {about_x, about_y}, rotor};
    causes_.push_back(weak);
    causes_.push_back(tilt);
  }
  cause("rotor_tilt", {{"x", 0.01}, {"y", 0.01}});
  cause("cg_offset", {{"x", 0.01 * arm}, {"y", 0.01 * arm}, {"z", 0.01 * arm}});
  cause("payload", {{"m", 0.02 * m}, {"mx", 2e-3 * m * arm}, {"my", 2e-3 * m * arm}, {"mz", 2e-3 * m * arm}});
  cause("products_of_inertia", {{"Jxy", 0.01 * J}, {"Jxz", 0.01 * J}, {"Jyz", 0.01 * J}});
  cause("imu_bias", {{"ax", 0.02}, {"ay", 0.02}, {"az", 0.02}});
  cause("imu_lever_arm", {{"x", 0.02 * arm}, {"y", 0.02 * arm}, {"z", 0.02 * arm}});
  cause("imu_misalignment", {{"x", 5e-3}, {"y", 5e-3}, {"z", 5e-3}});
}

VectorXd Model::null() const {
  VectorXd theta(static_cast<Eigen::Index>(parameters_.size()));
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    theta[static_cast<Eigen::Index>(i)] = parameters_[i].null;
  return theta;
}

}  // namespace rival
