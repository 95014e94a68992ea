// The flight as an ArduCopter 4.5 log: a main loop of 400 Hz, default or fast logging.
#include <cmath>
#include <numbers>

#include "case.h"
#include "dataflash_file.h"

namespace written {
namespace {

constexpr double kBoot = 41.7;  // s between boot and the start of the log
constexpr double kLate = 8e-4;  // s from a sample to the scheduler's log entry
constexpr double kDegree = std::numbers::pi / 180;

const DataflashFormat kFormats[] = {
    {129, "UNIT", "QbZ", "TimeUS,Id,Label", "s--", "F--"},
    {130, "MULT", "Qbd", "TimeUS,Id,Mult", "s--", "F--"},
    {131, "FMTU", "QBNN", "TimeUS,FmtType,UnitIds,MultIds", "s---", "F---"},
    {132, "PARM", "QNff", "TimeUS,Name,Value,Default", "s---", "F---"},
    {133, "MSG", "QZ", "TimeUS,Message", "s-", "F-"},
    {134, "EV", "QB", "TimeUS,Id", "s-", "F-"},
    {135, "MODE", "QMBB", "TimeUS,Mode,ModeNum,Rsn", "s---", "F---"},
    {136, "ARM", "QBIBB", "TimeUS,ArmState,ArmChecks,Forced,Method", "s----", "F----"},
    {137, "IMU", "QBffffffIIfBBHH", "TimeUS,I,GyrX,GyrY,GyrZ,AccX,AccY,AccZ,EG,EA,T,GH,AH,GHz,AHz",
     "s#EEEooo--O--zz", "F-000000-----00"},
    {138, "ATT", "QccccCCCCB", "TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw,ErrRP,ErrYaw,AEKF",
     "sddddhhdh-", "FBBBBBBBB-"},
    {139, "RATE", "Qfffffffffffff", "TimeUS,RDes,R,ROut,PDes,P,POut,YDes,Y,YOut,ADes,A,AOut,AOutSlew",
     "skk-kk-kk-oo--", "F?????????BB--"},
    {140, "RCOU", "QHHHHHHHHHHHHHH", "TimeUS,C1,C2,C3,C4,C5,C6,C7,C8,C9,C10,C11,C12,C13,C14",
     "sYYYYYYYYYYYYYY", "F--------------"},
    {141, "XKF1", "QBccCfffffffccce", "TimeUS,C,Roll,Pitch,Yaw,VN,VE,VD,dPD,PN,PE,PD,GX,GY,GZ,OH",
     "s#ddhnnnnmmmkkkm", "F-BBB0000000BBBB"},
    {142, "BAT", "QBfffffcfBBB", "TimeUS,Inst,Volt,VoltR,Curr,CurrTot,EnrgTot,Temp,Res,RemPct,H,SH",
     "s#vvAaXOw%-%", "F-000C0?0000"},
    {143, "ESC", "QBffffcfcf", "TimeUS,Instance,RPM,RawRPM,Volt,Curr,Temp,CTot,MotTemp,Err", "s#qqvAOaO%",
     "F-00--BCB-"},
    {144, "MOTB", "QfffffB", "TimeUS,LiftMax,BatVolt,ThLimit,ThrAvMx,ThrOut,FailFlags", "s------", "F------"},
};

double micros(double t) { return std::round((kBoot + t + kLate) * 1e6); }
double compass(double angle) { return std::fmod(angle / kDegree + 720, 360); }

class Writer {
 public:
  Writer(const Flight& flight, const Logging& logging) : flight_(flight), logging_(logging) {
    if (logging.swapped_outputs) output_of_motor_ = {0, 2, 3, 1};
  }

  void write(const std::string& path) {
    for (const DataflashFormat& format : kFormats) log_.define(format);
    log_.units();
    facts();
    bool was_armed = false;
    for (size_t k = 0; k < flight_.samples.size(); k += 10) {
      const Sample& s = flight_.samples[k];
      const double t = static_cast<double>(k) * kStep;
      const auto reached = [&](double when) { return t >= when && t < when + 10 * kStep; };
      if (s.armed != was_armed) {
        log_.record("EV", {micros(t), s.armed ? 10.0 : 11.0});
        log_.record("ARM", {micros(t), s.armed ? 1.0 : 0.0, 0, 0, 0});
        was_armed = s.armed;
      }
      if (reached(flight_.take_off)) log_.record("EV", {micros(t), 28});
      if (reached(flight_.landing + kContact)) log_.record("EV", {micros(t), 17});
      if (reached(flight_.landing + kLanded)) log_.record("EV", {micros(t), 18});
      const auto every = [&](size_t ticks) { return (k / 10) % ticks == 0; };
      if (logging_.fast || every(16)) imu(s, t);  // 25 Hz
      if (logging_.fast || every(40)) attitude(s, t), rate(s, t);
      if (every(40)) outputs(s, t), battery(t);
      if (every(20)) estimate(s, t);
      if (logging_.rotor_speeds && every(2)) esc(s, t, (k / 20) % 4);
    }
    log_.write(path);
  }

 private:
  void parameter(const std::string& name, double value) {
    log_.record("PARM", {micros(0), value, value}, name);
  }

  void facts() {
    log_.record("MSG", {micros(0)}, "ArduCopter V4.5.7 (2a3dc4b7)");
    log_.record("MSG", {micros(0)}, "ChibiOS: 6a85082c");
    log_.record("MSG", {micros(0)}, "CubeOrange 0037003C 31385107 36343637");
    log_.record("MSG", {micros(0)}, "Frame: QUAD/X");
    parameter("FRAME_CLASS", 1), parameter("FRAME_TYPE", 1);
    parameter("SCHED_LOOP_RATE", 400);
    parameter("LOG_BITMASK", 176126 + (logging_.fast ? 1 + 262144 : 0));
    parameter("INS_GYRO_FILTER", flight_.v.gyro_hz), parameter("INS_ACCEL_FILTER", flight_.v.accel_hz);
    parameter("INS_HNTCH_ENABLE", 0);
    parameter("MOT_PWM_MIN", kPwmMin), parameter("MOT_PWM_MAX", kPwmMax), parameter("MOT_PWM_TYPE", 0);
    parameter("MOT_SPIN_ARM", kSpinArm), parameter("MOT_SPIN_MIN", kSpinMin),
        parameter("MOT_SPIN_MAX", kSpinMax);
    parameter("MOT_THST_EXPO", kThrustExpo), parameter("MOT_THST_HOVER", 0.35);
    parameter("MOT_BAT_VOLT_MAX", 0), parameter("MOT_BAT_VOLT_MIN", 0), parameter("MOT_SLEW_UP_TIME", 0);
    for (size_t n = 0; n < 4; ++n) {
      const std::string servo = "SERVO" + std::to_string(output_of_motor_[n] + 1) + "_";
      parameter(servo + "FUNCTION", 33 + static_cast<double>(n));
      parameter(servo + "MIN", 1000), parameter(servo + "MAX", 2000), parameter(servo + "TRIM", 1000);
      parameter(servo + "REVERSED", 0);
    }
    log_.record("MODE", {micros(0), 0, 0, 1});
  }

  void imu(const Sample& s, double t) {
    for (const double instance : {0.0, 1.0}) {  // the second one has another bias
      const Vector3d w = s.gyro_filtered + instance * Vector3d(0.003, -0.002, 0.001), f = s.accel_filtered;
      log_.record(
          "IMU", {micros(t), instance, w.x(), w.y(), w.z(), f.x(), f.y(), f.z(), 0, 0, 35, 1, 1, 1000, 1000});
    }
  }
  void attitude(const Sample& s, double t) {
    const Vector3d e = euler(s), want = s.set.euler / kDegree;
    log_.record(
        "ATT", {micros(t), want.x(), e.x(), want.y(), e.y(), compass(s.set.euler.z()), e.z(), 0.01, 0.01, 3});
  }
  void rate(const Sample& s, double t) {
    const Vector3d w = s.gyro_filtered / kDegree, want = s.set.rate / kDegree;
    const Inputs& u = s.set.inputs;
    const double down = (s.q_WB * s.accel_filtered).z() + kGravity;
    log_.record("RATE", {micros(t), want.x(), w.x(), u[0], want.y(), w.y(), u[1], want.z(), w.z(), u[2], 0,
                         -down * 100, u[3], 0});
  }
  void outputs(const Sample& s, double t) {
    double c[4];
    for (size_t n = 0; n < 4; ++n) c[output_of_motor_[n]] = s.motors.stored[n];
    log_.record("RCOU", {micros(t), c[0], c[1], c[2], c[3], 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    log_.record("MOTB", {micros(t), 1, 1, 1, 1, s.set.inputs[3], 0});
  }
  void battery(double t) {
    const double volts = flight_.voltage(t);
    log_.record("BAT", {micros(t), 0, volts, volts, 14, 100, 1.5, 25, 0.01, 90, 1, 100});
  }
  void estimate(const Sample& s, double t) {
    const Vector3d e = euler(s), v = s.v_W, p = s.p_W;
    for (const double core : {0.0, 1.0})
      log_.record("XKF1", {micros(t), core, e.x(), e.y(), e.z(), v.x(), v.y(), v.z(), v.z(), p.x(), p.y(),
                           p.z(), 0, 0, 0, 488});
  }
  // One ESC every 5 ms in turn; Instance counts outputs.
  void esc(const Sample& s, double t, size_t output) {
    size_t motor = 0;
    while (output_of_motor_[motor] != output) ++motor;
    const double rpm = std::round(s.truth.Omega[motor] * 30 / std::numbers::pi * 7 / 100) * 100 / 7;
    log_.record("ESC",
                {micros(t), static_cast<double>(output), rpm, rpm, flight_.voltage(t), 3.5, 40, 50, 40, 0});
  }
  static Vector3d euler(const Sample& s) {  // deg; yaw from 0 to 360
    const Eigen::Matrix3d R = s.q_WB.toRotationMatrix();
    return {std::atan2(R(2, 1), R(2, 2)) / kDegree, -std::asin(R(2, 0)) / kDegree,
            compass(std::atan2(R(1, 0), R(0, 0)))};
  }

  const Flight& flight_;
  Logging logging_;
  DataflashFile log_;
  std::array<size_t, 4> output_of_motor_ = {0, 1, 2, 3};
};

}  // namespace

void write_dataflash(const std::string& path, const Flight& flight, const Logging& logging) {
  Writer(flight, logging).write(path);
}

}  // namespace written
