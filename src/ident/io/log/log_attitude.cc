// Quaternions and Euler angles of a flight log.
#include "ident/io/log/log_attitude.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"

namespace ident {
namespace {

using Attitude = std::array<std::vector<double>, 4>;

constexpr double kNormOff = 0.1;  // of a unit quaternion; further off it is something else

template <std::size_t N>
int columns_there(const NumberTable& table, const std::array<const char*, N>& names) {
  return static_cast<int>(
      std::ranges::count_if(names, [&](const char* name) { return table.find(name) != nullptr; }));
}

Eigen::Vector4d row(const Attitude& q, std::size_t i) { return {q[0][i], q[1][i], q[2][i], q[3][i]}; }

void put(Attitude& q, std::size_t i, const Eigen::Vector4d& value) {
  for (std::size_t k = 0; k < 4; ++k) q[k][i] = value(static_cast<Eigen::Index>(k));
}

Attitude from_angles(const NumberTable& table) {
  const auto& phi = *table.find("phi");
  const auto& theta = *table.find("theta");
  const auto& psi = *table.find("psi");
  Attitude q;
  for (auto& component : q) component.resize(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) put(q, i, quaternion_of(phi[i], theta[i], psi[i]));
  return q;
}

/// Unit length, and the sign that is nearer to the sample before. Returns how many rows were no unit
/// quaternions.
long normalise(Attitude& q) {
  long off = 0;
  Eigen::Vector4d before(1, 0, 0, 0);
  for (std::size_t i = 0; i < q[0].size(); ++i) {
    const Eigen::Vector4d value = row(q, i);
    const double norm = value.norm();
    const bool usable = std::abs(norm - 1.0) < kNormOff;
    if (!usable && !std::isnan(norm)) ++off;
    const Eigen::Vector4d unit = value / (value.dot(before) < 0.0 ? -norm : norm);
    put(q, i, usable ? unit : Eigen::Vector4d::Constant(kNaN));
    if (usable) before = unit;
  }
  return off;
}

}  // namespace

std::array<std::vector<double>, 4> take_attitude(const NumberTable& table, FlightLog& log) {
  constexpr std::array<const char*, 4> quaternion = {"qw", "qx", "qy", "qz"};
  constexpr std::array<const char*, 3> angles = {"phi", "theta", "psi"};
  Attitude q;
  if (columns_there(table, quaternion) == 4) {
    for (std::size_t k = 0; k < 4; ++k) q[k] = *table.find(quaternion[k]);
    if (columns_there(table, angles) > 0)
      log.notices.push_back(log.file + ": attitude is there twice; the quaternion is used");
  } else if (columns_there(table, angles) == 3) {
    q = from_angles(table);
  } else {
    if (columns_there(table, quaternion) + columns_there(table, angles) > 0)
      log.warnings.push_back(
          {"attitude_incomplete", log.file + ": attitude needs qw, qx, qy, qz or phi, theta, psi; "
                                             "one is missing, so attitude is not used"});
    return q;
  }
  const long off = normalise(q);
  if (off > 0)
    log.warnings.push_back(
        {"quaternion_norm", fmt::format("{}: qw, qx, qy, qz: no unit quaternion in {} rows; they "
                                        "count as not sampled",
                                        log.file, off)});
  return q;
}

void turn_attitude(FlightLog& log, BodyFrame body, WorldFrame world) {
  for (std::size_t i = 0; i < log.q_WB[0].size(); ++i)
    put(log.q_WB, i, attitude_to_ours(row(log.q_WB, i), body, world));
  normalise(log.q_WB);
}

}  // namespace ident
