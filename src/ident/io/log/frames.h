// Axes of other frames than ours: body FRD, world NED.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace ident {

/// Axes of a file's body frame: forward-right-down (ours), forward-left-up, right-forward-up.
enum class BodyFrame { frd, flu, rfu };
/// Axes of a file's world frame: north-east-down (ours), east-north-up, north-west-up.
enum class WorldFrame { ned, enu, nwu };

std::optional<BodyFrame> body_frame(const std::string& name);
std::optional<WorldFrame> world_frame(const std::string& name);
const std::vector<std::string>& body_frame_names();
const std::vector<std::string>& world_frame_names();

/// Rotation from the file's body axes to FRD, and from its world axes to NED.
Eigen::Matrix3d to_frd(BodyFrame frame);
Eigen::Matrix3d to_ned(WorldFrame frame);

/// Attitude (scalar first, body to world) from the file's frames to FRD and NED.
Eigen::Vector4d attitude_to_ours(const Eigen::Vector4d& q_file, BodyFrame body, WorldFrame world);

/// Quaternion, scalar first, of the ZYX angles phi, theta, psi.
Eigen::Vector4d quaternion_of(double phi, double theta, double psi);

}  // namespace ident
