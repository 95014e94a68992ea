// Springs and dampers at the feet and at the hubs of a vehicle.
#include "ident/fly/ground_contact.h"

#include <algorithm>

namespace ident {
namespace {

constexpr double kFrequency = 50.0;  // rad/s, w
constexpr double kDampingRatio = 0.7;
constexpr double kFriction = 0.8;  // rubber on asphalt
constexpr double kFeet = 4.0;
constexpr double kClear = 0.02;  // m, of a hub above the ground at least

}  // namespace

GroundContact::GroundContact(const Plant& plant, double legs)
    : c_B_(plant.centre_of_gravity()), ground_z_(plant.vehicle().ground_z), sinks_(plant.vehicle().g) {
  double reach = 0.05, lowest = -legs;
  for (const Rotor& rotor : plant.vehicle().rotors) {
    points_B_.push_back(rotor.r_B);
    reach = std::max(reach, std::hypot(rotor.r_B[0], rotor.r_B[1]));
    lowest = std::max(lowest, rotor.r_B[2] + kClear);
  }
  legs_ = std::max(legs > 0 ? legs : 0.5 * reach, lowest);
  const double foot = 0.5 * reach;
  for (const double x : {foot, -foot})
    for (const double y : {foot, -foot}) points_B_.emplace_back(x, y, legs_);
  stiffness_ = plant.mass() * kFrequency * kFrequency / kFeet;
  damping_ = 2.0 * kDampingRatio * plant.mass() * kFrequency / kFeet;
  sinks_ /= kFrequency * kFrequency;
}

double GroundContact::standing_z() const { return ground_z_ - legs_ + sinks_; }

Wrench<double> GroundContact::at(const BodyState<double>& state) const {
  Wrench<double> total{Vec3<double>::Zero(), Vec3<double>::Zero()};
  const Mat3<double> R_WB = rotation(state.q_WB);
  for (const Vec3<double>& r_B : points_B_) {
    const double depth = state.x_W[2] + R_WB.row(2).dot(r_B) - ground_z_;
    if (!(depth > 0)) continue;
    const Vec3<double> v_W = state.v_W + R_WB * cross(state.w_B, r_B);
    const double N = std::max(0.0, stiffness_ * depth + damping_ * v_W[2] * std::min(1.0, depth / sinks_));
    const double speed = std::hypot(v_W[0], v_W[1]);
    const double rub = speed > 0 ? std::min(kFriction * N / speed, damping_) : 0.0;
    const Vec3<double> F_B = R_WB.transpose() * Vec3<double>(-rub * v_W[0], -rub * v_W[1], -N);
    total.F_B += F_B;
    total.M_B += cross(Vec3<double>(r_B - c_B_), F_B);
  }
  return total;
}

}  // namespace ident
