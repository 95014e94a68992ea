// A case as files: what the program sees, the flight that is held out, and the truth.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "field_case.h"

namespace field {
namespace {

using nlohmann::json;

class CsvLine {
 public:
  explicit CsvLine(std::FILE* file) : file_(file) {}
  void cell(double value, bool sampled = true) {
    if (!first_) std::fputc(',', file_);
    first_ = false;
    if (sampled) std::fprintf(file_, "%.7g", value);
  }
  void end() { std::fputc('\n', file_), first_ = true; }

 private:
  std::FILE* file_;
  bool first_ = true;
};

std::string header(const Case& c) {
  const auto numbered = [&](const char* name) {
    std::string text;
    for (int i = 1; i <= c.v.rotors(); ++i) text += std::string(",") + name + std::to_string(i);
    return text;
  };
  std::string text = "t" + numbered(c.instruments.pulses ? "u" : "delta") + ",p,q,r,ax,ay,az";
  text += c.instruments.euler ? ",phi,theta,psi" : ",qw,qx,qy,qz";
  text += ",x,y,z,vx,vy,vz";
  if (c.instruments.rotor_speeds) text += numbered("omega");
  return text + (c.instruments.voltage ? ",vbat\n" : "\n");
}

Vector3d euler(const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), -std::asin(R(2, 0)), std::atan2(R(1, 0), R(0, 0))};
}

void write_attitude(CsvLine& line, const Row& row, const Instruments& in, bool sampled) {
  if (in.euler) {
    for (const double angle : euler(row.q_WB)) line.cell(angle, sampled);
    return;
  }
  for (const double part : {row.q_WB.w(), row.q_WB.x(), row.q_WB.y(), row.q_WB.z()}) line.cell(part, sampled);
}

void write_log(const std::string& path, const Case& c, const Flight& flight) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  const Instruments& in = c.instruments;
  std::fputs(header(c).c_str(), file);
  CsvLine line(file);
  for (const Row& row : flight.rows) {
    const auto shown = [&](bool fresh) { return fresh || !in.empty_cells; };
    line.cell(row.t);
    for (const double delta : row.command)
      line.cell(in.pulses ? 1000 + 1000 * delta : delta, shown(row.has_command));
    for (const double w : row.gyro) line.cell(w);
    for (const double a : row.accel) line.cell(a);
    write_attitude(line, row, in, shown(row.has_attitude));
    for (const double p : row.p_W) line.cell(p, shown(row.has_position));
    for (const double u : row.v_W) line.cell(u, shown(row.has_position));
    if (in.rotor_speeds) {
      for (const double Omega : row.Omega) line.cell(Omega, shown(row.has_speeds));
    }
    if (in.voltage) line.cell(row.voltage);
    line.end();
  }
  std::fclose(file);
}

json vector(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

json vehicle_json(const Vehicle& v) {
  return {{"layout", v.layout},
          {"rotors", v.rotors()},
          {"m", v.m},
          {"l", v.l},
          {"radius", v.radius},
          {"kT", v.kT},
          {"kQ", v.kQ},
          {"km", v.km},
          {"Omega_0", v.Omega_0},
          {"lag_up", v.lag_up},
          {"lag_down", v.lag_down},
          {"latency", v.latency},
          {"Jp", v.Jp},
          {"J", vector(v.J)},
          {"hover_speed", v.hover_speed()},
          {"hover_command", (v.hover_speed() - v.Omega_0) / v.km},
          {"cells", v.battery.cells},
          {"battery_reference", v.battery.reference}};
}

json effects_json(const Case& c) {
  const Effects& e = c.e;
  return {{"rotor_drag.kd", e.kd},
          {"rotor_drag.kd_with_tilt", effective_kd(c.v, e)},
          {"axial_inflow.kz_at_hover", effective_kz(c.v, c.e)},
          {"blade_flapping.kf", e.kf},
          {"tilt_per_advance", e.tilt},
          {"parasitic_drag.C", vector(e.C)},
          {"ground_effect.radius", e.ground_radius},
          {"wind_W", vector(e.wind_W)},
          {"battery_sag.n", e.sag_exponent},
          {"rotor_mismatch.rotor", e.weak_rotor + 1},
          {"rotor_mismatch.ratio", e.weak_ratio},
          {"cg_offset", vector(e.c_B)},
          {"products", vector(e.products)},
          {"imu_bias", vector(e.imu_bias)},
          {"imu_lever_arm", vector(e.imu_r_B)},
          {"imu_misalignment", vector(e.imu_turn)},
          {"arm_hz", e.arm_hz},
          {"slosh_share", e.slosh_share},
          {"slosh_hz", e.slosh_hz},
          {"propwash", e.propwash},
          {"bursts", e.bursts},
          {"vibration", e.vibration},
          {"dead_zone", e.dead_zone}};
}

json instruments_json(const Case& c) {
  const Instruments& in = c.instruments;
  return {{"log_hz", in.log_hz},
          {"command_hz", in.log_hz / in.command_every},
          {"loop_hz", c.tuning.loop_hz},
          {"rotor_speeds", in.rotor_speeds},
          {"speed_hz", in.log_hz / in.speed_every},
          {"voltage", in.voltage},
          {"estimator", in.estimator},
          {"empty_cells", in.empty_cells},
          {"gyro_order", in.gyro_order},
          {"gyro_hz", in.gyro_hz},
          {"accel_order", in.accel_order},
          {"accel_hz", in.accel_hz},
          {"gyro_delay", in.gyro_delay()},
          {"outside_delay", in.outside_delay},
          {"gyro_sigma", in.gyro_sigma()},
          {"accel_sigma", in.accel_sigma()},
          {"velocity_noise", in.velocity_noise},
          {"attitude_noise", in.attitude_noise},
          {"attitude_drift", in.attitude_drift},
          {"velocity_drift", in.velocity_drift},
          {"battery_compensation", c.tuning.battery_compensation}};
}

json flight_json(const Flight& f, const FlightSettings& s) {
  return {{"seconds", s.duration},
          {"manoeuvres", f.manoeuvres},
          {"greatest_rate", f.greatest_rate},
          {"greatest_tilt", f.greatest_tilt},
          {"greatest_speed", f.greatest_speed},
          {"lowest", f.lowest},
          {"saturated", f.saturated},
          {"mean_thrust", f.mean_thrust},
          {"voltage", {f.voltage_first, f.voltage_last}},
          {"command", {f.command_least, f.command_most}},
          {"rms_position_error", f.rms_position_error}};
}

// Effects among each other; constants among everything.
json shares_json(const Case& c) {
  std::set<std::string> effects = names_present(c);
  effects.merge(outside_present(c));
  std::erase_if(effects, [](const std::string& name) { return name.starts_with("parameter:"); });
  if (c.instruments.gyro_delay() > 0.002) effects.insert("sensor_delay");
  std::vector<std::string> among(effects.begin(), effects.end()), all = among;
  for (const char* name : {"m", "kT", "kQ", "km", "lag", "Omega_0", "Jxx", "Jyy", "Jzz"}) {
    all.push_back(std::string("parameter:") + name);
  }
  json out = json::object();
  const auto put = [&](const std::map<std::string, Share>& shares, bool constants, int log) {
    for (const auto& [name, s] : shares) {
      if (name.starts_with("parameter:") != constants) continue;
      out[name]["log" + std::to_string(log)] = {{"all", s.all},
                                                {"forces", s.forces},
                                                {"moments", s.moments},
                                                {"velocity_rms", s.velocity_rms},
                                                {"rate_rms", s.rate_rms}};
    }
  };
  for (int i = 0; i < 2; ++i) {
    const Ledger& ledger = *c.flights[static_cast<size_t>(i)].ledger;
    put(ledger.shares(c.instruments, among), false, i + 1);
    put(ledger.shares(c.instruments, all), true, i + 1);
  }
  return out;
}

json truth_json(const Case& c) {
  json t = {{"seed", c.seed}, {"case", c.index}, {"only", c.only}, {"plain", c.plain}};
  t["vehicle"] = vehicle_json(c.v);
  t["air"] = {{"level", c.stated.air}, {"gust_share", c.settings[0].gust_share}};
  for (const auto& [name, s] : c.stated.constants) {
    t["stated"][name] = {
        {"truth", s.truth}, {"value", s.value}, {"std", s.std}, {"overconfident", s.overconfident}};
  }
  t["states"] = {{"drag", c.stated.drag},
                 {"sag", c.stated.sag},
                 {"second_order", c.stated.second_order},
                 {"battery_voltage", c.stated.reference_voltage}};
  for (const auto& [name, range] : true_ranges(c)) t["true_ranges"][name] = {range.low, range.high};
  t["effects"] = effects_json(c);
  t["present"] = names_present(c);
  t["implied"] = names_implied(c);
  t["outside"] = outside_present(c);
  t["shares"] = shares_json(c);
  t["instruments"] = instruments_json(c);
  for (size_t i = 0; i < 3; ++i) t["flights"].push_back(flight_json(c.flights[i], c.settings[i]));
  return t;
}

}  // namespace

void write_case(const Case& c, const std::string& folder) {
  namespace fs = std::filesystem;
  char number[16];
  std::snprintf(number, sizeof number, "%04d", static_cast<int>(c.index));
  const fs::path seen = fs::path(folder) / "cases" / number, held = fs::path(folder) / "held" / number;
  const fs::path truth = fs::path(folder) / "truth";
  for (const auto& path : {seen, held, truth}) fs::create_directories(path);
  write_vehicle_file(seen / "vehicle.yaml", std::string("field_") + number, c.v, c.stated,
                     c.instruments.pulses);
  write_log(seen / "log1.csv", c, c.flights[0]);
  write_log(seen / "log2.csv", c, c.flights[1]);
  write_log(held / "log3.csv", c, c.flights[2]);
  std::ofstream(truth / (std::string(number) + ".json")) << truth_json(c).dump(1) << "\n";
}

}  // namespace field
