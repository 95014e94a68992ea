// Reads the rival's inputs; cells that are empty keep the value before, interpolated where that matters.
#include "rival_data.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "ident/io/vehicle/vehicle_read.h"

namespace rival {

namespace {

Vector3d vector_of(const YAML::Node& node) {
  return {node[0].as<double>(), node[1].as<double>(), node[2].as<double>()};
}

std::array<Rotor, 4> laid_out(const std::string& layout, double l, double slant) {
  const double d = l / std::sqrt(2.0), sa = std::sin(slant), ca = std::cos(slant);
  const Vector3d up(0, 0, -1);
  if (layout == "x")
    return {Rotor{{d, d, 0}, up, 1}, {{d, -d, 0}, up, -1}, {{-d, -d, 0}, up, 1}, {{-d, d, 0}, up, -1}};
  const double s = layout == "4sp" ? 1 : -1;
  return {Rotor{{l, 0, 0}, up, 1},
          {{0, -l, 0}, {-sa, 0, -ca}, s},
          {{-l, 0, 0}, up, 1},
          {{0, l, 0}, {sa, 0, -ca}, s}};
}

// Columns by name; an empty cell is NaN.
std::map<std::string, std::vector<double>> read_columns(const std::string& path) {
  std::ifstream in(path);
  std::string line, name;
  if (!std::getline(in, line)) throw std::runtime_error("cannot read " + path);
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, name, ',');) names.push_back(name);
  std::vector<std::vector<double>> columns(names.size());
  while (std::getline(in, line)) {
    const char* at = line.data();
    const char* const end = at + line.size();
    for (auto& column : columns) {
      double value = std::nan("");
      at = std::from_chars(at, end, value).ptr;
      column.push_back(value);
      if (at < end) ++at;
    }
  }
  std::map<std::string, std::vector<double>> result;
  for (std::size_t i = 0; i < names.size(); ++i) result[names[i]] = std::move(columns[i]);
  return result;
}

// Straight lines between the samples of a column of lower rate.
void bridge(const std::vector<double>& t, std::vector<double>& x) {
  std::size_t last = x.size();
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (std::isnan(x[k])) continue;
    for (std::size_t i = last == x.size() ? 0 : last + 1; i < k; ++i) {
      x[i] = last == x.size() ? x[k] : x[last] + (x[k] - x[last]) * (t[i] - t[last]) / (t[k] - t[last]);
    }
    last = k;
  }
  for (std::size_t i = last + 1; i < x.size(); ++i) x[i] = x[last];
}

}  // namespace

VehicleFile read_vehicle(const std::string& path) {
  const YAML::Node file = YAML::LoadFile(path);
  VehicleFile v;
  v.gravity = file["gravity"].as<double>();
  v.radius = file["propeller_radius"].as<double>();
  v.pulse_min = file["command"]["min"].as<double>();
  v.pulse_max = file["command"]["max"].as<double>();
  const auto take = [&](const std::string& name, const YAML::Node& node) {
    v.value[name] = node["value"].as<double>();
    v.std[name] = node["std"].as<double>();
  };
  take("m", file["mass"]);
  for (const auto& item : file["parameters"]) take(item.first.as<std::string>(), item.second);
  if (file["rotors"]) {
    for (std::size_t i = 0; i < 4; ++i) {
      const YAML::Node rotor = file["rotors"][i];
      v.rotors[i] = {vector_of(rotor["position"]), vector_of(rotor["axis"]),
                     rotor["spin"].as<std::string>() == "ccw" ? 1.0 : -1.0};
    }
  } else {
    const double slant = file["slant_deg"] ? file["slant_deg"].as<double>() * M_PI / 180 : 0;
    v.rotors = laid_out(file["layout"].as<std::string>(), file["arm"].as<double>(), slant);
  }
  return v;
}

Four Log::command(double from, double to, std::size_t* cursor) const {
  std::size_t& i = *cursor;
  while (i > 0 && t[i] > from) --i;
  while (i + 1 < t.size() && t[i + 1] <= from) ++i;
  if (i + 1 >= t.size() || t[i + 1] >= to) return delta[i];
  const double share = (t[i + 1] - from) / (to - from);
  return share * delta[i] + (1 - share) * delta[i + 1];
}

Log read_log(const std::string& path, const VehicleFile& vehicle) {
  auto columns = read_columns(path);
  Log log;
  log.t = columns.at("t");
  log.has_speed = columns.count("omega1") > 0;
  const std::vector<double> sampled = columns.at("vx");
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "vbat"}) bridge(log.t, columns.at(name));
  const std::size_t n = log.t.size();
  for (std::size_t k = 0; k < n; ++k) {
    Four delta;
    for (int i = 0; i < 4; ++i) {
      const std::string number = std::to_string(i + 1);
      const bool pulse = columns.count("u" + number) > 0;
      const double raw = columns.at((pulse ? "u" : "delta") + number)[k];
      delta[i] = pulse ? (raw - vehicle.pulse_min) / (vehicle.pulse_max - vehicle.pulse_min) : raw;
    }
    log.delta.push_back(delta);
  }
  const double rate = static_cast<double>(n - 1) / (log.t.back() - log.t.front());
  log.rows_per_block = std::max<std::size_t>(1, static_cast<std::size_t>(rate / 80));
  double next_fix = log.t.front();
  for (std::size_t from = 0; from + log.rows_per_block <= n; from += log.rows_per_block) {
    Block b{0, 0, Four::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero(), {}};
    Four q = Four::Zero();
    const double share = 1.0 / static_cast<double>(log.rows_per_block);
    bool fixed = false;
    for (std::size_t k = from; k < from + log.rows_per_block; ++k) {
      const auto add = [&](auto& sum, const auto& names) {
        for (int i = 0; i < static_cast<int>(names.size()); ++i)
          sum[i] += share * columns.at(names[static_cast<std::size_t>(i)])[k];
      };
      b.t += share * log.t[k];
      b.voltage += share * columns.at("vbat")[k];
      add(b.gyro, std::array{"p", "q", "r"});
      add(b.acc, std::array{"ax", "ay", "az"});
      add(b.p, std::array{"x", "y", "z"});
      add(b.v, std::array{"vx", "vy", "vz"});
      add(q, std::array{"qw", "qx", "qy", "qz"});
      if (log.has_speed) add(b.speed, std::array{"omega1", "omega2", "omega3", "omega4"});
      fixed = fixed || !std::isnan(sampled[k]);
    }
    b.q = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
    if (fixed && b.t >= next_fix) {
      log.fixes.push_back(log.blocks.size());
      next_fix = b.t + 0.095;
    }
    log.blocks.push_back(b);
  }
  return log;
}

}  // namespace rival
