// Simple autopilots that close the loop: attitude, yaw rate and climb by the conventions of ArduPilot and
// Betaflight, written down here anew from their sources.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "ident/fly/udp_socket.h"

namespace ident::testing {

/// What the pilot wants: right, nose up, clockwise from above, up.
struct Wish {
  double roll = 0.0, pitch = 0.0, yaw_rate = 0.0, climb = 0.0;
};

/// What an autopilot knows, in the pilot's signs.
struct Attitude {
  double roll = 0.0, pitch = 0.0, yaw = 0.0, roll_rate = 0.0, pitch_rate = 0.0, yaw_rate = 0.0, climb = 0.0;
};

/// Shares of the motors' range: roll right, nose up, clockwise, lift.
struct Control {
  double roll = 0.0, pitch = 0.0, yaw = 0.0, lift = 0.0;
};

/// Gains for the vehicle of flown_vehicle.h.
inline Control controlled(const Attitude& x, const Wish& to) {
  const double p = 5.0 * (to.roll - x.roll), q = 5.0 * (to.pitch - x.pitch);
  return {.roll = 0.016 * (p - x.roll_rate),
          .pitch = 0.016 * (q - x.pitch_rate),
          .yaw = 0.12 * (to.yaw_rate - x.yaw_rate),
          .lift = 0.5 + 0.06 * (to.climb - x.climb)};
}

/// The servo packet of ArduPilot with 16 or 32 channels.
inline std::string servo_packet(std::uint16_t rate, std::uint32_t frame,
                                const std::array<double, 4>& pulse_us, bool wide = false) {
  std::string bytes(wide ? 72 : 40, '\0');
  const std::uint16_t magic = wide ? 29569 : 18458;
  std::memcpy(bytes.data(), &magic, 2), std::memcpy(bytes.data() + 2, &rate, 2);
  std::memcpy(bytes.data() + 4, &frame, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto pulse = static_cast<std::uint16_t>(std::lround(pulse_us[i]));
    std::memcpy(bytes.data() + 8 + 2 * i, &pulse, 2);
  }
  return bytes;
}

/// ArduCopter, FRAME_CLASS 1, FRAME_TYPE 1 over the JSON back end: motor 1 front right, 2 rear left, 3 front
/// left, 4 rear right; 1 and 2 turn counter-clockwise. Roll takes off the right and adds to the left, pitch
/// adds to the front, yaw to the right adds to those that turn to the left.
class FakeArduPilot {
 public:
  explicit FakeArduPilot(std::uint16_t port) : server_{ipv4_address("127.0.0.1"), port} {}

  static std::array<double, 4> mixed(const Control& u) {
    const auto pulse = [&](int roll, int pitch, int yaw) {
      return 1000.0 + 1000.0 * std::clamp(u.lift + roll * u.roll + pitch * u.pitch + yaw * u.yaw, 0.0, 1.0);
    };
    return {pulse(-1, 1, 1), pulse(1, -1, 1), pulse(1, 1, -1), pulse(-1, -1, -1)};
  }

  /// Sends bytes; the line that comes back, or nothing.
  std::string exchange(const std::string& bytes, double wait = 5.0) {
    socket_.send(server_, bytes);
    const std::optional<Datagram> answer = socket_.receive(wait);
    return answer ? answer->bytes : "";
  }

  /// One frame with these pulses: the state after it.
  const nlohmann::json& frame(const std::array<double, 4>& pulse_us) {
    const std::string line = exchange(servo_packet(rate, count++, pulse_us));
    state = line.empty() ? nlohmann::json() : nlohmann::json::parse(line);
    return state;
  }

  Attitude attitude() const {
    const auto &a = state["attitude"], &w = state["imu"]["gyro"];
    return {a[0], a[1], a[2], w[0], w[1], w[2], -state["velocity"][2].get<double>()};
  }

  /// Flies for some seconds.
  void fly(const Wish& wish, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * rate); ++i)
      frame(mixed(state.is_object() ? controlled(attitude(), wish) : Control{}));
  }

  std::uint16_t rate = 400;
  std::uint32_t count = 0;
  nlohmann::json state;

 private:
  UdpSocket socket_{"127.0.0.1", 0};
  Endpoint server_;
};

/// What Betaflight SITL makes of an fdm_packet: its body is forward, left, up and its world north, west, up.
struct BetaflightView {
  double timestamp;
  std::array<double, 3> gyro, accelerometer;  ///< rad/s, m/s^2
  std::array<double, 4> q;
  double up, climb, longitude, latitude, pressure;
};

enum class BetaflightBuild { released, bridge, gazebo };

inline BetaflightView received(const std::string& bytes, BetaflightBuild build) {
  std::array<double, 18> p{};
  std::memcpy(p.data(), bytes.data(), std::min(bytes.size(), sizeof p));
  BetaflightView v{.timestamp = p[0],
                   .gyro = {p[1], -p[2], build == BetaflightBuild::gazebo ? p[3] : -p[3]},
                   .accelerometer = {-p[4], -p[5], -p[6]},
                   .q = {p[7], p[8], p[9], p[10]},
                   .up = p[16],
                   .climb = p[13],
                   .longitude = p[14],
                   .latitude = p[15],
                   .pressure = p[17]};
  const std::array<double, 4> q = v.q;
  if (build == BetaflightBuild::released) v.q = {q[0], q[1], -q[2], -q[3]};  // imu.c: two rows negated
  if (build == BetaflightBuild::gazebo) {
    const double k = std::sqrt(0.5), y = -q[2], z = -q[3];
    v.q = {k * (q[0] - z), k * (q[1] - y), k * (y + q[1]), k * (z + q[0])};
  }
  return v;
}

/// Roll right, nose up and heading of a turn from forward, left, up to north, west, up.
inline Attitude pilots_view(const BetaflightView& v) {
  const auto [w, x, y, z] = v.q;
  return {.roll = std::atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
          .pitch = -std::asin(std::clamp(2 * (w * y - z * x), -1.0, 1.0)),
          .yaw = -std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
          .roll_rate = v.gyro[0],
          .pitch_rate = -v.gyro[1],
          .yaw_rate = -v.gyro[2],
          .climb = v.climb};
}

/// Betaflight's mixer QUADX: motor 1 rear right, 2 front right, 3 rear left, 4 front left; 2 and 3 turn
/// counter-clockwise. 0 to 1 each, in the order of its motors.
inline std::array<double, 4> betaflight_motors(const Control& u) {
  const auto motor = [&](int roll, int pitch, int yaw) {
    return std::clamp(u.lift + roll * u.roll + pitch * u.pitch + yaw * u.yaw, 0.0, 1.0);
  };
  return {motor(-1, -1, -1), motor(-1, 1, 1), motor(1, -1, 1), motor(1, 1, -1)};
}

/// The servo_packet that carries them: released builds send motors 2, 3, 4, 1.
inline std::string motor_packet(const std::array<double, 4>& motors, BetaflightBuild build) {
  std::array<float, 4> sent{};
  for (std::size_t i = 0; i < 4; ++i)
    sent[i] = static_cast<float>(motors[build == BetaflightBuild::released ? (i + 1) % 4 : i]);
  return {reinterpret_cast<const char*>(sent.data()), sizeof sent};
}

}  // namespace ident::testing
