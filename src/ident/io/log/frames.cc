// Each frame is a permutation of axes with signs, and a proper rotation.
//
//   R_WB = C_world R_file C_body^T     C_world: file's world axes to NED, C_body: file's body axes to FRD
#include "ident/io/log/frames.h"

#include <algorithm>
#include <cmath>

namespace ident {
namespace {

Eigen::Matrix3d half_turn_about_x() { return Eigen::Vector3d(1, -1, -1).asDiagonal(); }

/// First and second axis exchanged, third reversed.
Eigen::Matrix3d exchange() {
  Eigen::Matrix3d C;
  C << 0, 1, 0,  //
      1, 0, 0,   //
      0, 0, -1;
  return C;
}

std::optional<std::size_t> place(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

}  // namespace

const std::vector<std::string>& body_frame_names() {
  static const std::vector<std::string> names = {"frd", "flu", "rfu"};
  return names;
}

const std::vector<std::string>& world_frame_names() {
  static const std::vector<std::string> names = {"ned", "enu", "nwu"};
  return names;
}

std::optional<BodyFrame> body_frame(const std::string& name) {
  const auto at = place(body_frame_names(), name);
  if (!at) return std::nullopt;
  return static_cast<BodyFrame>(*at);
}

std::optional<WorldFrame> world_frame(const std::string& name) {
  const auto at = place(world_frame_names(), name);
  if (!at) return std::nullopt;
  return static_cast<WorldFrame>(*at);
}

Eigen::Matrix3d to_frd(BodyFrame frame) {
  if (frame == BodyFrame::flu) return half_turn_about_x();
  return frame == BodyFrame::rfu ? exchange() : Eigen::Matrix3d::Identity();
}

Eigen::Matrix3d to_ned(WorldFrame frame) {
  if (frame == WorldFrame::nwu) return half_turn_about_x();
  return frame == WorldFrame::enu ? exchange() : Eigen::Matrix3d::Identity();
}

Eigen::Vector4d attitude_to_ours(const Eigen::Vector4d& q_file, BodyFrame body, WorldFrame world) {
  if (body == BodyFrame::frd && world == WorldFrame::ned) return q_file;
  const Eigen::Quaterniond file(q_file(0), q_file(1), q_file(2), q_file(3));
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(to_ned(world)) * file * Eigen::Quaterniond(to_frd(body)).conjugate();
  return {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Vector4d quaternion_of(double phi, double theta, double psi) {
  using Axis = Eigen::AngleAxisd;
  const Eigen::Quaterniond q = Axis(psi, Eigen::Vector3d::UnitZ()) * Axis(theta, Eigen::Vector3d::UnitY()) *
                               Axis(phi, Eigen::Vector3d::UnitX());
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace ident
