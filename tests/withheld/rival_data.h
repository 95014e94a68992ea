// What the rival reads of a case: vehicle file and logs, averaged to blocks of about 10 ms.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <map>
#include <string>
#include <vector>

namespace rival {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Four = Eigen::Vector4d;

struct Rotor {
  Vector3d r, a;
  double s;
};

struct VehicleFile {
  double gravity = 9.81, radius = 0.1, pulse_min = 1000, pulse_max = 2000;
  std::array<Rotor, 4> rotors;
  std::map<std::string, double> value, std;  // of m, kT, kQ, km, omega_m, zeta_m, Jxx, Jyy, Jzz
};
VehicleFile read_vehicle(const std::string& path);

// A block of rows: means of what the sensors showed.
struct Block {
  double t, voltage;
  Four speed;  // measured, if the log has it
  Vector3d gyro, acc, p, v;
  Eigen::Quaterniond q;
};

struct Log {
  std::vector<double> t;  // of every row, with its commands
  std::vector<Four> delta;
  std::size_t rows_per_block = 1;
  bool has_speed = false;
  std::vector<Block> blocks;
  std::vector<std::size_t> fixes;  // blocks at which velocity was really sampled, 0.1 s apart
  // Mean command between two times less than two rows apart; `cursor` remembers where it looked last.
  Four command(double from, double to, std::size_t* cursor) const;
  double step() const {
    return (blocks.back().t - blocks.front().t) / static_cast<double>(blocks.size() - 1);
  }
};
Log read_log(const std::string& path, const VehicleFile& vehicle);

}  // namespace rival
