// Allocation by the flight model itself, so that its signs are stated once.
#include "ident/bench/slant/slant_allocation.h"

#include <algorithm>
#include <cmath>

#include "ident/effects/all_parameters.h"
#include "ident/effects/catalogue.h"
#include "ident/model/body.h"

namespace ident {
namespace {

/// The vehicle's constants as far as they bear on thrust at rest; a unit mass and inertia stand in.
std::vector<double> constants_at_rest(const Vehicle& vehicle, double alpha) {
  std::vector<double> p = null_parameters();
  for (const ParameterInfo& info : all_parameters()) {
    const bool counts = info.index == param::kT || info.index == param::kQ ||
                        info.name.starts_with("rotor_mismatch.") || info.name.starts_with("rotor_tilt.") ||
                        info.name.starts_with("cg_offset.");
    if (counts && vehicle.has(info.name)) p[static_cast<std::size_t>(info.index)] = vehicle.value(info.name);
  }
  for (const int unit : {param::m, param::Jxx, param::Jyy, param::Jzz}) p[static_cast<std::size_t>(unit)] = 1;
  p[param::alpha] = alpha;
  return p;
}

bool is_lateral(const Rotor& rotor) { return std::fabs(rotor.r_B.y()) > std::fabs(rotor.r_B.x()); }

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

}  // namespace

Eigen::Matrix<double, 6, Eigen::Dynamic> rotor_wrenches(const Vehicle& vehicle, double alpha) {
  const std::vector<double> p = constants_at_rest(vehicle, alpha);
  const EffectSet<double> effects(p, active_effects(p));
  const Body<double, EffectSet<double>> body(vehicle, p, effects);
  const BodyState<double> at_rest{Vec4<double>(1, 0, 0, 0), Vec3<double>::Zero(), Vec3<double>::Zero(),
                                  Vec3<double>::Zero()};
  const Mat3<double> R_WB = Mat3<double>::Identity();
  const std::size_t N = vehicle.rotors.size();
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrenches(6, static_cast<Eigen::Index>(N));
  for (std::size_t n = 0; n < N; ++n) {
    std::vector<MotorState<double>> motors(N);
    motors[n].Omega = 1.0 / std::sqrt(p[param::kT]);
    const Wrench<double> w = body.wrench(at_rest, R_WB, motors);
    wrenches.col(static_cast<Eigen::Index>(n)) << w.F_B,
        w.M_B - cross(body.centre_of_gravity(), w.F_B);  // (4), (5) of body.h
  }
  return wrenches;
}

Eigen::MatrixXd input_shares(const std::vector<Rotor>& rotors) {
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rotors.size()), 4);
  for (std::size_t n = 0; n < rotors.size(); ++n) {
    const bool lateral = is_lateral(rotors[n]);
    shares.row(static_cast<Eigen::Index>(n)) << 1.0, lateral ? -sign(rotors[n].r_B.y()) : 0.0,
        lateral ? 0.0 : sign(rotors[n].r_B.x()), lateral ? -1.0 : 1.0;
  }
  return shares;
}

bool is_slantable(const std::vector<Rotor>& rotors) {
  if (rotors.size() != 4) return false;
  Eigen::Vector4d about_x = Eigen::Vector4d::Zero(), about_y = about_x;
  for (std::size_t n = 0; n < 4; ++n) {
    if (rotors[n].s != rotors[0].s || rotors[n].a_B.z() >= 0.0) return false;
    const bool lateral = is_lateral(rotors[n]);
    const auto i = static_cast<Eigen::Index>(n);
    (lateral ? about_x : about_y)(i) = sign(lateral ? rotors[n].r_B.y() : rotors[n].r_B.x());
  }
  const auto is_pair = [](const Eigen::Vector4d& v) { return v.cwiseAbs().sum() == 2.0 && v.sum() == 0.0; };
  return is_pair(about_x) && is_pair(about_y);
}

std::vector<Rotor> with_slant_directions(std::vector<Rotor> rotors) {
  if (std::ranges::any_of(rotors, [](const Rotor& r) { return !r.slant_B.isZero(); })) return rotors;
  for (Rotor& rotor : rotors) {
    if (!is_lateral(rotor)) continue;
    const Eigen::Vector3d level(rotor.a_B.x(), rotor.a_B.y(), 0.0);
    // Across the arm and level: forwards on the right, backwards on the left, where rotors turn ccw.
    const Eigen::Vector3d across(rotor.r_B.y(), -rotor.r_B.x(), 0.0);
    rotor.slant_B = level.norm() > 1e-3 ? level.normalized() : (rotor.s * across).normalized();
  }
  return rotors;
}

Eigen::Matrix<double, 6, 4> input_allocation(const Vehicle& vehicle, double alpha) {
  Eigen::MatrixXd shares = input_shares(vehicle.rotors);
  for (std::size_t n = 0; n < vehicle.rotors.size(); ++n)  // a slanted rotor pulls harder for the same lift
    shares.row(static_cast<Eigen::Index>(n)) /= -axis_at(vehicle.rotors[n], alpha).z();
  return rotor_wrenches(vehicle, alpha) * shares;
}

}  // namespace ident
