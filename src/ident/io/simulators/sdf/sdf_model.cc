// Sums links of an SDF model into one rigid body, and takes them away from one.
#include "ident/io/simulators/sdf/sdf_model.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace ident {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Pose {
  Vector3d r = Vector3d::Zero();
  Matrix3d R = Matrix3d::Identity();
};

Pose pose(const Fields& fields, const std::string& name) {
  if (!fields.has(name)) return {};
  const std::vector<double> p = fields.numbers(name, 6);
  return {{p[0], p[1], p[2]},
          (Eigen::AngleAxisd(p[5], Vector3d::UnitZ()) * Eigen::AngleAxisd(p[4], Vector3d::UnitY()) *
           Eigen::AngleAxisd(p[3], Vector3d::UnitX()))
              .toRotationMatrix()};
}

std::string rotor(std::size_t n) { return fmt::format("rotor{}.", n + 1); }

/// A link's pose in the frame of the base link, which may sit off the model's origin but not be turned.
Pose link_pose(const Fields& fields, const std::string& key) {
  Pose link = pose(fields, key + "pose");
  const Pose base = pose(fields, "base.pose");
  if (!base.R.isIdentity(1e-12)) fields.fail("base.pose", "turns the base link: only moved ones are read");
  link.r -= base.r;
  return link;
}

Matrix3d parallel_axis(double m, const Vector3d& r) {
  return m * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
}

/// One link about its own centre, in the frame of the base link.
MassProperties lump(const Fields& f, const std::string& key, const Vector3d* hub) {
  Pose link = link_pose(f, key);
  if (hub) link.r = *hub;
  const Pose inertial = pose(f, key + "inertial");
  const auto moment = [&](const char* name) { return f.number(key + name, 0.0); };
  MassProperties out{.m = f.positive(key + "mass")};
  Matrix3d J;
  J << moment("ixx"), moment("ixy"), moment("ixz"), moment("ixy"), moment("iyy"), moment("iyz"),
      moment("ixz"), moment("iyz"), moment("izz");
  const Matrix3d R = link.R * inertial.R;
  out.J = R * J * R.transpose();
  out.c_B = link.r + link.R * inertial.r;
  return out;
}

MassProperties joined(const std::vector<MassProperties>& lumps) {
  MassProperties all;
  for (const MassProperties& one : lumps) all.m += one.m, all.c_B += one.m * one.c_B;
  if (all.m > 0) all.c_B /= all.m;
  for (const MassProperties& one : lumps) all.J += one.J + parallel_axis(one.m, one.c_B - all.c_B);
  return all;
}

}  // namespace

std::size_t sdf_rotors(const Fields& fields) {
  std::size_t n = 0;
  while (n < 8 && (fields.has(rotor(n) + "pose") || fields.has(rotor(n) + "mass"))) ++n;
  return n;
}

Vector3d sdf_hub(const Fields& fields, std::size_t n) { return link_pose(fields, rotor(n)).r; }
Vector3d sdf_axis(const Fields& fields, std::size_t n) { return link_pose(fields, rotor(n)).R.col(2); }

MassProperties sdf_body(const Fields& fields, bool with_base, const std::vector<Vector3d>& hubs) {
  std::vector<MassProperties> lumps;
  if (with_base) lumps.push_back(lump(fields, "base.", nullptr));
  const std::size_t rotors = sdf_rotors(fields);
  for (std::size_t n = 0; n < rotors; ++n)
    if (fields.has(rotor(n) + "mass"))
      lumps.push_back(lump(fields, rotor(n), n < hubs.size() ? &hubs[n] : nullptr));
  for (int n = 1; n < 1000; ++n) {
    const std::string key = fmt::format("link{}.", n);
    if (fields.has(key + "mass")) lumps.push_back(lump(fields, key, nullptr));
    if (!fields.has(key + "mass") && !fields.has(key + "pose")) break;
  }
  return joined(lumps);
}

MassProperties sdf_base(const Fields& fields, const MassProperties& whole, const MassProperties& rest) {
  MassProperties base{.m = whole.m - rest.m};
  if (!(base.m > 0))
    fields.fail("base.mass",
                fmt::format("the other links weigh {:.4g} kg, the vehicle {:.4g} kg", rest.m, whole.m));
  base.c_B = (whole.m * whole.c_B - rest.m * rest.c_B) / base.m;
  base.J = whole.J - rest.J - parallel_axis(rest.m, rest.c_B - whole.c_B) -
           parallel_axis(base.m, base.c_B - whole.c_B);
  if (!(Eigen::SelfAdjointEigenSolver<Matrix3d>(base.J, Eigen::EigenvaluesOnly).eigenvalues()[0] > 0))
    fields.fail("base.ixx", "the inertia of the other links leaves nothing for the base link");
  return base;
}

Vector3d roll_pitch_to(const Vector3d& axis) {
  // R = Rz(0) Ry(pitch) Rx(roll), third column (sin p cos r, -sin r, cos p cos r).
  return {std::asin(std::clamp(-axis.y(), -1.0, 1.0)), std::atan2(axis.x(), axis.z()), 0.0};
}

}  // namespace ident
