// The flight as a Betaflight log: a PID loop of 4 kHz, rows at 1 kHz (4.5) or 500 Hz (4.2), from arming to
// disarming.
#include <cmath>
#include <numbers>
#include <optional>

#include "blackbox_file.h"
#include "case.h"

namespace written {
namespace {

constexpr int kOneG = 2048, kPoles = 14;
constexpr size_t kIntraEvery = 128;  // runs of the PID loop: 32 ms
constexpr double kBoot = 25.3;       // s

void add(std::vector<BlackboxField>& to, const std::string& name, int count, const BlackboxField& like) {
  for (int i = 0; i < count; ++i) {
    to.push_back(like);
    to.back().name = name + "[" + std::to_string(i) + "]";
  }
}

// In the order of blackboxMainFields.
std::vector<BlackboxField> fields(bool old_firmware) {
  std::vector<BlackboxField> f;
  f.push_back({"loopIteration", false, kZero, kUnsignedVb, kIncrement, kNull});
  f.push_back({"time", false, kZero, kUnsignedVb, kLine, kSignedVb});
  add(f, "axisP", 3, {"", true, kZero, kSignedVb, kPrevious, kSignedVb});
  add(f, "axisI", 3, {"", true, kZero, kSignedVb, kPrevious, kTag2});
  add(f, "axisD", 2, {"", true, kZero, kSignedVb, kPrevious, kSignedVb});
  add(f, "axisF", 3, {"", true, kZero, kSignedVb, kPrevious, kSignedVb});
  add(f, "rcCommand", 4, {"", true, kZero, kSignedVb, kPrevious, kTag8S16});
  f.back().is_signed = false, f.back().i_encoding = kUnsignedVb;
  add(f, "setpoint", 4, {"", true, kZero, kSignedVb, kPrevious, kTag8S16});
  f.push_back({"vbatLatest", false, kVbatRef, kNeg14, kPrevious, kTag8Svb});
  f.push_back({"amperageLatest", true, kZero, kSignedVb, kPrevious, kTag8Svb});
  f.push_back({old_firmware ? "BaroAlt" : "baroAlt", true, kZero, kSignedVb, kPrevious, kTag8Svb});
  f.push_back({"rssi", false, kZero, kUnsignedVb, kPrevious, kTag8Svb});
  add(f, "gyroADC", 3, {"", true, kZero, kSignedVb, kAverage, kSignedVb});
  if (!old_firmware) add(f, "gyroUnfilt", 3, {"", true, kZero, kSignedVb, kAverage, kSignedVb});
  add(f, "accSmooth", 3, {"", true, kZero, kSignedVb, kAverage, kSignedVb});
  add(f, "motor", 4, {"", false, kMotor0, kSignedVb, kAverage, kSignedVb});
  BlackboxField& motor0 = f[f.size() - 4];
  motor0.i_predictor = kMinMotor, motor0.i_encoding = kUnsignedVb;
  if (!old_firmware) add(f, "eRPM", 4, {"", false, kZero, kUnsignedVb, kPrevious, kSignedVb});
  return f;
}

std::int32_t whole(double x) { return static_cast<std::int32_t>(std::lround(x)); }

// Bidirectional DShot reports the period of the electrical rotation: 9 bits and a shift, us; logged as
// eRPM/100.
std::int32_t erpm(double Omega) {
  if (Omega < 20) return 0;  // no telemetry at rest
  const double period = 60e6 / (Omega * 30 / std::numbers::pi * kPoles / 2);
  if (!(period < 65408)) return 0;
  int shift = 0;
  while (period / (1 << shift) > 511) ++shift;
  const int us = static_cast<int>(std::lround(period / (1 << shift))) << shift;
  return (600000 + us / 2) / us;
}

class Writer {
 public:
  Writer(const Flight& flight, const Logging& logging)
      : flight_(flight),
        old_(logging.old_firmware),
        log_(fields(old_), {whole(100 * flight.voltage(0)), static_cast<std::int32_t>(kMotorLow)}) {}

  void write(const std::string& path) {
    log_.field_headers();
    facts();
    const size_t every = old_ ? 8 : 4;
    std::optional<size_t> first;
    double last = 0;
    for (size_t k = 0; k < flight_.samples.size(); ++k) {
      if (!flight_.samples[k].armed) continue;
      if (!first) {
        first = k;
        log_.slow(1, 0);
        log_.beep(static_cast<std::uint32_t>(micros(k)));
      }
      const size_t iteration = k - *first;
      if (iteration % kIntraEvery == 0)
        log_.intra(row(k, iteration));
      else if (iteration % kIntraEvery % every == 0)
        log_.inter(row(k, iteration));
      if (static_cast<double>(k) * kStep > last + 1) last = static_cast<double>(k) * kStep, log_.slow(3, 0);
    }
    log_.end(1);
    log_.write(path);
  }

 private:
  static std::int32_t micros(size_t k) { return whole((kBoot + static_cast<double>(k) * kStep) * 1e6); }

  void facts() {
    const auto header = [&](const char* key, const std::string& value) { log_.header(key, value); };
    header("Firmware type", "Cleanflight");
    header("Firmware revision",
           old_ ? "Betaflight 4.2.11 (948ba6339) STM32F7X2" : "Betaflight 4.5.1 (77d01ba3b) STM32F7X2");
    header("Firmware date", old_ ? "Nov  9 2021 20:29:32" : "Jul 27 2024 05:47:50");
    header("Board information", "ZEEZ ZEEZF7V2");
    header("Log start datetime", "0000-01-01T00:00:00.000+00:00");
    header("Craft name", flight_.v.name);
    header("I interval", std::to_string(kIntraEvery));
    header("P interval", old_ ? "8" : "4");
    header("P ratio", old_ ? "16" : "32");
    header("minthrottle", "1070");
    header("maxthrottle", "2000");
    header("gyro_scale", "0x3f800000");
    header("motorOutput", "158,2047");
    if (!old_) header("motor_kv", "1960");
    header("acc_1G", std::to_string(kOneG));
    header("vbat_scale", "110");
    header("vbatcellvoltage", "330,350,430");
    header("vbatref", std::to_string(whole(100 * flight_.voltage(0))));
    header("looptime", "125");
    header("gyro_sync_denom", "1");
    header("pid_process_denom", "2");
    header("gyro_hardware_lpf", "0");
    if (old_) {
      header("gyro_lowpass_type", "0"), header("gyro_lowpass_hz", "250"),
          header("gyro_lowpass_dyn_hz", "0,500");
      header("gyro_lowpass2_type", "0"), header("gyro_lowpass2_hz", "500");
      header("gyro_notch_hz", "0,0"), header("gyro_notch_cutoff", "0,0");
      header("dyn_notch_max_hz", "0");
    } else {
      header("gyro_lpf1_type", "0"), header("gyro_lpf1_static_hz", "250"),
          header("gyro_lpf1_dyn_hz", "0,500");
      header("gyro_lpf2_type", "0"), header("gyro_lpf2_static_hz", "500");
      header("gyro_notch_hz", "0,0"), header("gyro_notch_cutoff", "0,0");
      header("dyn_notch_count", "0");
    }
    header("dshot_bidir", old_ ? "0" : "1");
    if (!old_) header("motor_poles", std::to_string(kPoles)), header("yaw_motors_reversed", "0");
    header("acc_lpf_hz", std::to_string(whole(100 * flight_.v.accel_hz)));
    header("acc_hardware", "1");
    header("motor_pwm_protocol", old_ ? "7" : "6");
    header("motor_pwm_rate", "480");
    header("dshot_idle_value", "550");
    header("debug_mode", "0");
    if (!old_)
      header("thrust_linear", "0"), header("motor_output_limit", "100"),
          header("blackbox_high_resolution", "0");
  }

  std::vector<std::int32_t> row(size_t k, size_t iteration) const {
    const Sample& s = flight_.samples[k];
    std::vector<std::int32_t> r = {static_cast<std::int32_t>(iteration), micros(k)};
    const auto put = [&](const Vector3d& x) { r.insert(r.end(), {whole(x[0]), whole(x[1]), whole(x[2])}); };
    const Vector3d signs(1, -1, -1);  // forward, left, up
    const double degree = 180 / std::numbers::pi;
    const Vector3d want = degree * signs.cwiseProduct(s.set.rate), pid = 500 * s.set.inputs.head<3>();
    put(pid), put(Vector3d::Zero());  // P and I of the controller
    r.insert(r.end(), {0, 0, 0, 0, 0});
    put(want / 2), r.push_back(whole(1000 + 1000 * s.set.inputs[3]));
    put(want), r.push_back(whole(1000 * s.set.inputs[3]));
    r.insert(r.end(), {whole(100 * flight_.voltage(static_cast<double>(k) * kStep)), 1500,
                       whole(-100 * s.p_W.z()), 1000});
    put(degree * signs.cwiseProduct(s.gyro_filtered));
    if (!old_) put(degree * signs.cwiseProduct(s.gyro));
    put(kOneG / kGravity * signs.cwiseProduct(s.accel_filtered));
    for (const double motor : s.motors.stored) r.push_back(whole(motor));
    if (!old_)
      for (const double Omega : s.truth.Omega) r.push_back(erpm(Omega));
    return r;
  }

  const Flight& flight_;
  bool old_;
  BlackboxFile log_;
};

}  // namespace

void write_blackbox(const std::string& path, const Flight& flight, const Logging& logging) {
  Writer(flight, logging).write(path);
}

}  // namespace written
