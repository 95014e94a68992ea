// What the server has to know of an autopilot: what its datagrams say, and what it wants to be told.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ident/fly/motor_order.h"
#include "ident/fly/served_vehicle.h"

namespace ident {

/// Commands out of a datagram, or why it is none.
struct Commands {
  std::vector<double> pulse_us;        ///< per output of the autopilot
  std::optional<std::uint32_t> frame;  ///< the autopilot's count of its frames, if it counts
  double step = 0.0;                   ///< s to go on by, where the autopilot says
  std::string refused;                 ///< what is wrong with the datagram; empty: nothing
};

/// One autopilot, as one of its builds talks.
class Autopilot {
 public:
  virtual ~Autopilot() = default;
  /// What a datagram asks for; never throws, whatever the bytes.
  virtual Commands read(std::string_view datagram) const = 0;
  /// The datagram that tells it what its sensors read.
  virtual std::string write(const Readings& readings) const = 0;
  /// Which rotor each of its outputs drives. Throws UsageError where the vehicle has none of its frames.
  virtual MotorOrder order(const Vehicle& vehicle) const = 0;
};

/// An autopilot in the list: its name, its ports and its pace.
struct AutopilotInfo {
  std::string_view name, meaning;
  std::uint16_t port = 0;           ///< at which commands arrive
  std::uint16_t state_port = 0;     ///< to which readings go; 0: where commands come from
  double rate = 0.0;                ///< readings a second against the clock, Hz; 0: one for each command
  std::vector<std::string> builds;  ///< words of --build, the first is the default; empty: there is one
  std::unique_ptr<Autopilot> (*make)(const std::string& build) = nullptr;
  std::string_view start;  ///< how to start the autopilot's side
};

}  // namespace ident
