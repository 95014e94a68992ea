// ArduPilot SITL's JSON back end [ArduPilot, libraries/SITL/SIM_JSON.h, SIM_JSON.cpp,
// examples/JSON/readme.md]: each frame it sends its servo outputs, waits for the state, and takes the time
// from there.
//
//   u16 magic 18458 (29569: 32 channels), u16 frame_rate Hz, u32 frame_count, u16 pulse us [16 or 32]
//
// Both worlds are NED and both bodies FRD, so that nothing is turned. Its reader knows no white space after a
// colon before 4.1 and looks for the keys in the order of the text.
#include <fmt/format.h>

#include <cmath>

#include "ident/core/error.h"
#include "ident/fly/autopilot.h"
#include "ident/io/packed/little_endian.h"

namespace ident {
namespace {

constexpr std::uint16_t kMagic16 = 18458, kMagic32 = 29569;
constexpr std::size_t kHeader = 8;  // bytes
/// Slower than this its own reader takes no step (SIM_JSON.cpp: deltat < 0.1).
constexpr int kSlowestRate = 11;  // Hz

const std::map<int, const char*>& class_names() {
  static const std::map<int, const char*> names = {{1, "quad"}, {2, "hexa"}, {3, "octa"}};
  return names;
}

std::string triple(const Vec3<double>& v) { return fmt::format("[{},{},{}]", v[0], v[1], v[2]); }

/// Roll, pitch, yaw, rad, for builds that know no quaternion.
Vec3<double> euler(const Mat3<double>& R_WB) {
  return {std::atan2(R_WB(2, 1), R_WB(2, 2)), std::asin(std::clamp(-R_WB(2, 0), -1.0, 1.0)),
          std::atan2(R_WB(1, 0), R_WB(0, 0))};
}

class ArduPilot : public Autopilot {
 public:
  Commands read(std::string_view datagram) const override {
    Commands commands;
    if (datagram.size() < kHeader) {
      commands.refused = fmt::format("{} bytes, too few for a servo packet", datagram.size());
      return commands;
    }
    const auto magic = load<std::uint16_t>(datagram.data());
    const std::size_t channels = magic == kMagic16 ? 16 : magic == kMagic32 ? 32 : 0;
    const auto rate = load<std::uint16_t>(datagram.data() + 2);
    if (channels == 0)
      commands.refused = fmt::format("magic {} where {} or {} is due", magic, kMagic16, kMagic32);
    else if (datagram.size() != kHeader + 2 * channels)
      commands.refused = fmt::format("{} bytes where {} channels take {}", datagram.size(), channels,
                                     kHeader + 2 * channels);
    else if (rate < kSlowestRate)
      commands.refused = fmt::format("a frame rate of {} Hz, ArduPilot takes {} or more", rate, kSlowestRate);
    if (!commands.refused.empty()) return commands;
    commands.step = 1.0 / rate;
    commands.frame = load<std::uint32_t>(datagram.data() + 4);
    for (std::size_t i = 0; i < channels; ++i)
      commands.pulse_us.push_back(load<std::uint16_t>(datagram.data() + kHeader + 2 * i));
    return commands;
  }

  std::string write(const Readings& r) const override {
    const Vec4<double>& q = r.q_WB;
    std::string text =
        fmt::format("\n{{\"timestamp\":{},\"imu\":{{\"gyro\":{},\"accel_body\":{}}},\"position\":{},", r.t,
                    triple(r.gyro_B), triple(r.f_B), triple(r.x_W - r.start_W));
    text += fmt::format("\"attitude\":{},\"quaternion\":[{},{},{},{}],\"velocity\":{}",
                        triple(euler(rotation(q))), q[0], q[1], q[2], q[3], triple(r.v_W));
    if (r.voltage) text += fmt::format(",\"battery\":{{\"voltage\":{}}}", *r.voltage);
    return text + "}\n";
  }

  MotorOrder order(const Vehicle& vehicle) const override {
    for (const auto& [frame, arms] : preferred()) {
      const auto rotors = rotors_on_frame(vehicle, *arms);
      if (!rotors) continue;
      return {*rotors, fmt::format("FRAME_CLASS {} ({}), FRAME_TYPE {}: {}", frame.first,
                                   class_names().at(frame.first), frame.second, order_in_words(*rotors))};
    }
    throw UsageError(
        fmt::format("the rotors are those of no ArduPilot frame known here ({}): give --order, the "
                    "rotor of each output in turn",
                    rotors_in_words(vehicle)));
  }

 private:
  using Frame = std::pair<std::pair<int, int>, const std::vector<FrameArm>*>;
  /// X before plus, then the frames with other numbers or spins.
  static std::vector<Frame> preferred() {
    std::vector<Frame> list;
    for (const auto& [frame, arms] : ardupilot_frames()) list.push_back({frame, &arms});
    std::ranges::stable_sort(list, {}, [](const Frame& f) { return f.first.second != 1; });
    return list;
  }
};

}  // namespace

AutopilotInfo ardupilot_autopilot() {
  return {
      .name = "ardupilot",
      .meaning = "ArduPilot SITL by its JSON back end, in lockstep",
      .port = 9002,
      .make = [](const std::string&) -> std::unique_ptr<Autopilot> { return std::make_unique<ArduPilot>(); },
      .start = "sim_vehicle.py -v ArduCopter --model JSON:127.0.0.1"};
}

}  // namespace ident
