// The rival's model: the base equations and the catalogue's effects, evaluated along the measured states.
#pragma once

#include "rival_data.h"

namespace rival {

struct Parameter {
  std::string name;          // effect.name for effects
  double null, step, prior;  // value without it, step for differences, standard deviation (0: none)
};

// A cause that may be named: the parameters that it frees.
struct Cause {
  std::string name;
  std::vector<int> parameters;
  int rotor = 0;  // of rotor_mismatch, rotor_tilt
};

constexpr std::size_t kSeries = 16;  // accelerometer 3, gyro 3, velocity 3, attitude 3, rotor speeds 4
using Series = std::array<VectorXd, kSeries>;

// The values of all parameters, by their symbols.
struct Terms {
  double m, kT, kQ, km, omega_m, zeta_m, delay, sag, slow, kd, kz, kh, kf, C, ground, curve, Jp, tau;
  Vector3d wind, c, bias, lever, turn, gyro_bias;
  Matrix3d J;
  Eigen::Matrix<double, 3, 4> axis;
  Four share;
};

struct Spin {
  std::vector<Four> Omega, dOmega;  // means over blocks, predicted from the commands
  std::vector<Four> used;           // what thrust is computed with
};

struct Accelerations {
  std::vector<Vector3d> f, dw, shown;  // at the origin; by the accelerometer
};

class Model {
 public:
  Model(const VehicleFile& vehicle, const std::vector<Log>& logs);

  const std::vector<Parameter>& parameters() const { return parameters_; }
  const std::vector<Cause>& causes() const { return causes_; }
  int index(const std::string& name) const { return index_.at(name); }
  VectorXd null() const;
  double typical_drag() const { return 0.3 * vehicle_.value.at("m") / (4 * hover_); }

  // Measured minus predicted, one for each log.
  std::vector<Series> residuals(const VectorXd& theta) const;

 private:
  void list_parameters();
  int add(const std::string& name, double step, double null = 0, double prior = 0);
  Terms terms(std::size_t log, const VectorXd& theta) const;
  Spin integrate(const Log& log, const Terms& terms) const;
  void blend(const Log& log, Spin* spin) const;
  const Spin& spin(std::size_t log, const Terms& terms) const;
  Accelerations accelerate(const Log& log, const Spin& spin, const Terms& terms) const;
  Series residuals(std::size_t log, const VectorXd& theta) const;

  VehicleFile vehicle_;
  const std::vector<Log>& logs_;
  double hover_, voltage_;
  std::vector<Parameter> parameters_;
  std::vector<Cause> causes_;
  std::map<std::string, int> index_;
  mutable std::map<std::vector<double>, Spin> spins_;
};

}  // namespace rival
