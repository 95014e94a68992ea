// The flight as the micro-SD card of a Crazyflie holds it: two event streams of the IMU beside one of fixed
// rate.
#include <array>
#include <cmath>
#include <numbers>

#include "bytes.h"
#include "case.h"

namespace written {
namespace {

constexpr double kBoot = 12.4;  // s
constexpr std::uint16_t kGyro = 0, kAccel = 1, kFixed = 65535;

std::uint32_t crc32(const std::vector<char>& data) {  // polynomial of zlib
  std::uint32_t crc = 0xffffffff;
  for (const char c : data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc;
}

void stream(Bytes& out, std::uint16_t id, const std::string& name,
            std::initializer_list<const char*> variables) {
  out.put(id).text(name).zeros(1).put(static_cast<std::uint16_t>(variables.size()));
  for (const char* variable : variables) out.text(variable).zeros(1);
}

Vector3d flu(const Vector3d& x) { return {x.x(), -x.y(), -x.z()}; }

}  // namespace

void write_card(const std::string& path, const Flight& flight) {
  Bytes out;
  out.put(std::uint8_t{0xbc}).each<std::uint16_t>(2, 3);
  stream(out, kGyro, "estGyroscope", {"gyro.x(f)", "gyro.y(f)", "gyro.z(f)"});
  stream(out, kAccel, "estAcceleration", {"acc.x(f)", "acc.y(f)", "acc.z(f)"});
  stream(
      out, kFixed, "fixedFrequency",
      {"motor.m1(H)", "motor.m2(H)", "motor.m3(H)", "motor.m4(H)", "stateEstimate.x(f)", "stateEstimate.y(f)",
       "stateEstimate.z(f)", "stateEstimate.vx(f)", "stateEstimate.vy(f)", "stateEstimate.vz(f)",
       "stateEstimate.roll(f)", "stateEstimate.pitch(f)", "stateEstimate.yaw(f)", "stateEstimate.qx(f)",
       "stateEstimate.qy(f)", "stateEstimate.qz(f)", "stateEstimate.qw(f)", "pm.vbat(f)"});
  for (size_t k = 0; k < flight.samples.size(); k += 4) {  // 1 kHz
    const Sample& s = flight.samples[k];
    const double t = static_cast<double>(k) * kStep, degree = 180 / std::numbers::pi;
    const auto micros = static_cast<std::uint64_t>(std::llround((kBoot + t) * 1e6));
    const auto floats = [&](const Vector3d& x) { out.each<float>(x.x(), x.y(), x.z()); };
    out.put(kGyro).put(micros), floats(degree * flu(s.gyro_filtered));
    out.put(kAccel).put(micros + 20), floats(flu(s.accel_filtered) / kGravity);
    if (k % 8 != 0) continue;  // 500 Hz
    out.put(kFixed).put(micros + 60);
    for (const double motor : s.motors.stored) out.put(static_cast<std::uint16_t>(motor));
    floats(flu(s.p_W)), floats(flu(s.v_W));
    const Eigen::Quaterniond q(s.q_WB.w(), s.q_WB.x(), -s.q_WB.y(), -s.q_WB.z());
    const Eigen::Matrix3d R = q.toRotationMatrix();
    // roll, yaw as usual; stateEstimate.pitch is stored with the opposite sign.
    floats(degree * Vector3d(std::atan2(R(2, 1), R(2, 2)), std::asin(R(2, 0)), std::atan2(R(1, 0), R(0, 0))));
    out.each<float>(q.x(), q.y(), q.z(), q.w(), flight.voltage(t));
  }
  out.put(crc32(out.data()));
  out.write(path);
}

}  // namespace written
