// Writes what the user has, and the truth where the diagnosis does not look.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mended_case.h"

namespace mended {

namespace {

using Eigen::Vector3d;

void cell(std::ostream& out, double value, int digits) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), ",%.*f", digits, value);
  out << text.data();
}

void cells(std::ostream& out, const Vector3d& values, int digits) {
  for (int n = 0; n < 3; ++n) cell(out, values[n], digits);
}

std::string log_csv(const Case& c, const withheld::Flight& flight) {
  const withheld::Instruments& i = c.instruments;
  std::ostringstream out;
  out << "t,delta1,delta2,delta3,delta4,p,q,r,ax,ay,az,qw,qx,qy,qz,x,y,z,vx,vy,vz";
  if (i.rotor_speeds) out << ",omega1,omega2,omega3,omega4";
  out << ",vbat\n";
  for (std::size_t k = 0; k < flight.rows.size(); ++k) {
    const withheld::Row& row = flight.rows[k];
    std::ostringstream line;
    cell(line, row.t, 6);
    for (int n = 0; n < withheld::kRotors; ++n) cell(line, row.delta[n], 6);
    cells(line, row.shown.gyro, 5), cells(line, row.shown.acc, 4);
    for (const double part : {row.shown.q.w(), row.shown.q.x(), row.shown.q.y(), row.shown.q.z()})
      cell(line, part, 6);
    if (k % static_cast<std::size_t>(i.position_every) == 0)
      cells(line, row.shown.p, 4), cells(line, row.shown.v, 4);
    else
      line << ",,,,,,";
    for (int n = 0; i.rotor_speeds && n < withheld::kRotors; ++n) cell(line, row.speed[n], 2);
    if (k % static_cast<std::size_t>(i.voltage_every) == 0)
      cell(line, row.voltage, 3);
    else
      line << ',';
    out << line.str().substr(1) << '\n';
  }
  return out.str();
}

// True states of the flight that is held out, with its commands.
std::string truth_csv(const withheld::Flight& flight) {
  std::ostringstream out;
  out << "t,delta1,delta2,delta3,delta4,x,y,z,vx,vy,vz,qw,qx,qy,qz,p,q,r,omega1,omega2,omega3,omega4\n";
  for (std::size_t k = 0; k < flight.rows.size(); ++k) {
    const withheld::Instant& now = flight.truth[k];
    std::ostringstream line;
    cell(line, now.t, 6);
    for (int n = 0; n < withheld::kRotors; ++n) cell(line, flight.rows[k].delta[n], 6);
    cells(line, now.motion.p, 6), cells(line, now.motion.v, 6);
    for (const double part : {now.motion.q.w(), now.motion.q.x(), now.motion.q.y(), now.motion.q.z()})
      cell(line, part, 8);
    cells(line, now.motion.w, 7);
    for (int n = 0; n < withheld::kRotors; ++n) cell(line, now.spin.Omega[n], 3);
    out << line.str().substr(1) << '\n';
  }
  return out.str();
}

nlohmann::json truth_json(const Case& c, int index, std::uint64_t campaign_seed) {
  nlohmann::json truth = {{"schema", "ident.mended/1"},
                          {"case", index},
                          {"campaign_seed", campaign_seed},
                          {"seed", c.seed},
                          {"target", c.target},
                          {"attempts", c.attempts},
                          {"layout", c.vehicle.layout},
                          {"arm", c.vehicle.arm},
                          {"rate", c.instruments.rate},
                          {"rotor_speeds", c.instruments.rotor_speeds}};
  for (const Present& p : c.present)
    truth["effects"].push_back({{"name", p.member.name},
                                {"form", p.member.form},
                                {"size", p.size},
                                {"parameters", p.member.parameters(p.size)},
                                {"accompanying", p.member.accompanying}});
  for (const std::string& name : withheld::base_parameter_names())
    truth["base"][name] = {{"truth", withheld::base_parameter(c.vehicle, name)},
                           {"stated_over_truth", c.wrong_by.at(name)}};
  for (std::size_t log = 0; log < c.flights.size(); ++log)
    truth["flights"].push_back({{"manoeuvres", c.flights[log].manoeuvres},
                                {"fastest", c.flights[log].fastest},
                                {"steepest", c.flights[log].steepest},
                                {"turbulence", c.settings[log].gusts.sigma}});
  return truth;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

std::string stated_vehicle(const Case& c, const std::string& name) {
  const withheld::Vehicle& v = c.vehicle;
  const auto stated = [&](const std::string& constant) {
    return withheld::base_parameter(v, constant) * c.wrong_by.at(constant);
  };
  std::ostringstream out;
  out.precision(10);
  out << "name: " << name << "\ngravity: " << v.gravity << "\nmass: " << stated("m") << "\nrotors:\n";
  for (const withheld::Rotor& rotor : v.rotors)
    out << "  - {position: [" << rotor.r.x() << ", " << rotor.r.y() << ", " << rotor.r.z() << "], axis: ["
        << rotor.a.x() << ", " << rotor.a.y() << ", " << rotor.a.z()
        << "], spin: " << (rotor.s > 0 ? "ccw" : "cw") << "}\n";
  out << "propeller_radius: " << v.radius << "\nair_density: " << v.air_density << "\nparameters:\n";
  for (const std::string& constant : withheld::base_parameter_names())
    if (constant != "m") out << "  " << constant << ": " << stated(constant) << "\n";
  return out.str();
}

void write_case(const Case& c, int index, std::uint64_t campaign_seed, const std::string& folder) {
  std::array<char, 16> number;
  std::snprintf(number.data(), number.size(), "%04d", index);
  const std::filesystem::path root(folder), place = root / "cases" / number.data();
  const std::string name = number.data();
  write_file(place / "target", c.target + "\n");
  write_file(place / "stated.yaml", stated_vehicle(c, "case_" + name));
  for (int log = 0; log < kShown; ++log)
    write_file(place / ("log" + std::to_string(log + 1) + ".csv"),
               log_csv(c, c.flights[static_cast<std::size_t>(log)]));
  write_file(root / "truth" / (name + ".json"), truth_json(c, index, campaign_seed).dump(1) + "\n");
  write_file(root / "truth" / (name + "_log3.csv"), truth_csv(c.flights.back()));
}

}  // namespace mended
