// Writes a case as the diagnosis gets it, and the truth where the diagnosis does not look.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "withheld_case.h"

namespace withheld {

namespace {

class Line {
 public:
  void cell(double value, int digits) {
    separate();
    std::array<char, 32> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, digits);
    text_.append(buffer.data(), end.ptr);
  }
  void empty() { separate(); }
  void end() {
    text_ += '\n';
    first_ = true;
  }
  const std::string& text() const { return text_; }

 private:
  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }
  std::string text_;
  bool first_ = true;
};

std::string log_csv(const Case& c, const Flight& flight) {
  const Instruments& i = c.instruments;
  std::string header = "t";
  const bool commands = c.order.commands;
  for (int n = 1; commands && n <= kRotors; ++n)
    header += (i.pulse_widths ? ",u" : ",delta") + std::to_string(n);
  header += ",p,q,r,ax,ay,az,qw,qx,qy,qz,x,y,z,vx,vy,vz";
  for (int n = 1; i.rotor_speeds && n <= kRotors; ++n) header += ",omega" + std::to_string(n);
  Line line;
  const Vehicle& v = c.vehicle;
  for (std::size_t k = 0; k < flight.rows.size(); ++k) {
    const Row& row = flight.rows[k];
    line.cell(row.t, 6);
    for (int n = 0; commands && n < kRotors; ++n) {
      if (i.pulse_widths)
        line.cell(v.pulse_min + row.delta[n] * (v.pulse_max - v.pulse_min), 0);
      else
        line.cell(row.delta[n], 6);
    }
    for (int n = 0; n < 3; ++n) line.cell(row.shown.gyro[n], 5);
    for (int n = 0; n < 3; ++n) line.cell(row.shown.acc[n], 4);
    for (const double part : {row.shown.q.w(), row.shown.q.x(), row.shown.q.y(), row.shown.q.z()})
      line.cell(part, 6);
    for (const Eigen::Vector3d& part : {row.shown.p, row.shown.v}) {
      for (int n = 0; n < 3; ++n) {
        if (k % static_cast<std::size_t>(i.position_every) == 0)
          line.cell(part[n], 4);
        else
          line.empty();
      }
    }
    for (int n = 0; i.rotor_speeds && n < kRotors; ++n) line.cell(row.speed[n], 2);
    if (k % static_cast<std::size_t>(i.voltage_every) == 0)
      line.cell(row.voltage, 3);
    else
      line.empty();
    line.end();
  }
  return header + ",vbat\n" + line.text();
}

nlohmann::json flights_json(const Case& c) {
  nlohmann::json all = nlohmann::json::array();
  for (std::size_t log = 0; log < c.flights.size(); ++log) {
    const Flight& f = c.flights[log];
    all.push_back({{"manoeuvres", f.manoeuvres},
                   {"fastest", f.fastest},
                   {"steepest", f.steepest},
                   {"lowest", f.lowest},
                   {"farthest_from_reference", f.farthest},
                   {"turbulence", c.settings[log].gusts.sigma},
                   {"turbulence_time", c.settings[log].gusts.time},
                   {"voltage", {f.truth.front().voltage, f.truth.back().voltage}}});
  }
  return all;
}

nlohmann::json vehicle_json(const Case& c) {
  const Instruments& i = c.instruments;
  nlohmann::json all = {{"layout", c.vehicle.layout},
                        {"arm", c.vehicle.arm},
                        {"propeller_radius", c.vehicle.radius},
                        {"hover_speed", c.vehicle.hover_speed()},
                        {"hover_command", c.vehicle.hover_command()},
                        {"rate", i.rate},
                        {"rotor_speeds", i.rotor_speeds},
                        {"commands", c.order.commands},
                        {"noise",
                         {{"gyro", i.gyro},
                          {"acc", i.acc},
                          {"attitude", i.attitude},
                          {"position", i.position},
                          {"velocity", i.velocity},
                          {"attitude_drift", i.attitude_drift},
                          {"drift_time", i.drift_time},
                          {"velocity_bias", i.velocity_bias},
                          {"speed_share", i.speed_share}}}};
  for (const std::string& name : base_parameter_names()) {
    all["base"][name] = {{"truth", base_parameter(c.vehicle, name)},
                         {"stated", c.known.at(name).value},
                         {"std", c.known.at(name).std}};
  }
  return all;
}

nlohmann::json truth_json(const Case& c, int index) {
  nlohmann::json truth = {{"schema", "ident.withheld/1"}, {"case", index},
                          {"kind", c.order.kind},         {"seed", c.seed},
                          {"attempts", c.attempts},       {"outside", nullptr}};
  truth["effects"] = nlohmann::json::array();
  std::set<std::string> accompanying, exclude;
  for (const Withheld& w : c.withheld) {
    nlohmann::json entry = {{"name", w.member.name},
                            {"form", w.member.form},
                            {"size", w.size},
                            {"size_over_limit", w.over_limit},
                            {"size_over_limit_joint", w.over_limit_joint},
                            {"freedom", w.member.freedom},
                            {"parameters", w.member.parameters(w.size)}};
    if (!w.member.wrong_parameter.empty()) {
      entry["parameters"] = {{w.member.wrong_parameter, base_parameter(c.vehicle, w.member.wrong_parameter)}};
    }
    if (c.order.kind == "outside") {
      truth["outside"] = entry;
      continue;
    }
    truth["effects"].push_back(entry);
    exclude.insert(w.member.name);
    accompanying.insert(w.member.accompanying.begin(), w.member.accompanying.end());
  }
  exclude.insert(accompanying.begin(), accompanying.end());
  truth["accompanying"] = accompanying;
  truth["exclude"] = exclude;
  truth["look_alikes"] = nlohmann::json::array();
  for (const LookAlike& other : c.look_alikes) {
    truth["look_alikes"].push_back({{"effect", other.effect}, {"left_over_limit", other.left}});
  }
  truth["vehicle"] = vehicle_json(c);
  truth["flights"] = flights_json(c);
  return truth;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

void write_case(const Case& c, int index, const std::string& folder) {
  std::array<char, 16> number;
  std::snprintf(number.data(), number.size(), "%04d", index);
  const std::filesystem::path root(folder), place = root / "cases" / number.data();
  write_file(place / "vehicle.yaml", vehicle_yaml(c.vehicle, c.known, std::string("case_") + number.data()));
  for (std::size_t log = 0; log < c.flights.size(); ++log) {
    write_file(place / ("log" + std::to_string(log + 1) + ".csv"), log_csv(c, c.flights[log]));
  }
  const nlohmann::json truth = truth_json(c, index);
  write_file(root / "truth" / (std::string(number.data()) + ".json"), truth.dump(1) + "\n");
  std::string names;  // all that run.sh has to know of the truth
  for (const auto& name : truth["exclude"]) names += (names.empty() ? "" : ",") + name.get<std::string>();
  if (!names.empty()) write_file(root / "truth" / (std::string(number.data()) + ".exclude"), names + "\n");
}

}  // namespace withheld
