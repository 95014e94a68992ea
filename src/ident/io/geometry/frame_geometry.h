// Where motors sit and how they turn, as the parameters of an autopilot say.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ident/data/log_streams.h"
#include "ident/model/vehicle.h"

namespace ident {

/// Rotors in the order of the log's commands.
struct FrameGeometry {
  std::vector<Rotor> rotors;
  std::vector<std::string> source;  ///< for each rotor: the parameters it comes from
  bool arm_is_known = false;        ///< else positions are for an arm that was assumed
  bool spin_is_known = false;
};

constexpr double kAssumedArm = 0.25;  ///< m, of a frame of 500 mm, where a log states directions alone

/// Where a motor sits seen from above, degrees from the nose, clockwise; its spin, +1 counter-clockwise.
struct FrameArm {
  double degrees;
  int spin;
};

/// ArduPilot's frames that are known here, by FRAME_CLASS and FRAME_TYPE, motors in its order
/// [AP_MotorsMatrix.cpp].
const std::map<std::pair<int, int>, std::vector<FrameArm>>& ardupilot_frames();

/// PX4 (1.13 and later), from CA_ROTOR*. Throws DataError where its rotors tilt or where it is no multirotor.
std::optional<FrameGeometry> px4_geometry(const LogStreams& log);

/// ArduPilot, from FRAME_CLASS and FRAME_TYPE (before 3.5: FRAME). Empty for frames that are in no table
/// here.
std::optional<FrameGeometry> ardupilot_geometry(const LogStreams& log);

/// Bitcraze's frame of the Crazyflie 2, which its log does not state.
FrameGeometry crazyflie_geometry();

}  // namespace ident
