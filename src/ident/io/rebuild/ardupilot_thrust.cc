// Mixer and thrust curve by the parameters of a log.
#include "ident/io/rebuild/ardupilot_thrust.h"

#include <cmath>

#include "ident/io/geometry/frame_geometry.h"

namespace ident {

std::optional<Eigen::MatrixXd> ardupilot_mix(const LogStreams& log) {
  const std::optional<FrameGeometry> frame = ardupilot_geometry(log);
  if (!frame) return std::nullopt;
  Eigen::MatrixXd mix(frame->rotors.size(), 4);
  for (std::size_t n = 0; n < frame->rotors.size(); ++n) {
    const Rotor& rotor = frame->rotors[n];
    mix.row(static_cast<Eigen::Index>(n)) << -rotor.r_B[1] / kAssumedArm, rotor.r_B[0] / kAssumedArm,
        static_cast<double>(rotor.s), 1.0;
  }
  return mix;
}

double ArdupilotCurve::command(double thrust, double lift, double volts) const {
  const double straight = 1 - expo;
  const double ratio =
      expo == 0 ? lift * thrust
                : (std::sqrt(straight * straight + 4 * expo * lift * thrust) - straight) / (2 * expo);
  return spin_min + (spin_max - spin_min) * ratio / volts;
}

double ArdupilotCurve::thrust(double command, double lift, double volts) const {
  const double ratio = volts * (command - spin_min) / (spin_max - spin_min);
  return ((1 - expo) * ratio + expo * ratio * ratio) / lift;
}

std::optional<ArdupilotCurve> ardupilot_curve(const LogStreams& log) {
  const auto expo = log.parameter("MOT_THST_EXPO"), low = log.parameter("MOT_SPIN_MIN"),
             high = log.parameter("MOT_SPIN_MAX");
  if (!expo || !low || !high || !(*high > *low) || !(std::abs(*expo) <= 1)) return std::nullopt;
  return ArdupilotCurve{*expo, *low, *high};
}

}  // namespace ident
