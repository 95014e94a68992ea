// Reads a flight log, CSV or streams: columns, time, units, frames, checks.
#include "ident/io/log/read_flight_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/io/csv/table_checks.h"
#include "ident/io/file/whole_file.h"
#include "ident/io/log/log_attitude.h"
#include "ident/io/log/log_columns.h"
#include "ident/io/log/log_quaternion.h"
#include "ident/io/log/log_signals.h"
#include "ident/io/log/log_times.h"
#include "ident/io/log/profiles.h"
#include "ident/io/log/stream_table.h"
#include "ident/io/log_cleaning/log_checks.h"
#include "ident/io/log_cleaning/log_checks_motion.h"
#include "ident/io/log_cleaning/log_checks_rotors.h"
#include "ident/io/log_cleaning/log_jumps.h"
#include "ident/io/log_cleaning/log_spikes.h"
#include "ident/io/log_formats/read_log_streams.h"
#include "ident/io/log_formats/refusals.h"
#include "ident/io/rebuild/rebuilt_commands.h"

namespace ident {
namespace {

using Rows = std::vector<double>;

class Builder {
 public:
  Builder(NumberTable table, const Vehicle& vehicle, const std::optional<LogMap>& map, LogContent content,
          const LogColumns& columns, std::vector<double> breaks, double first)
      : table_(std::move(table)),
        vehicle_(vehicle),
        content_(content),
        map_(map.value_or(LogMap{})),
        columns_(columns),
        first_(first) {
    log_.file = table_.file;
    log_.t = *table_.find("t");
    log_.warnings = table_.warnings;
    log_.notices = table_.notices;
    log_.notices.insert(log_.notices.end(), columns.notices.begin(), columns.notices.end());
    log_.breaks = std::move(breaks);
    if (content_ == LogContent::motion) map_.windows.clear();  // those are of the flight, on another clock
  }

  FlightLog run() {
    check_time(log_, columns_.header_line, columns_.time_unit_stated);
    take_windows();
    leave_out_ground();
    take_commands();
    take_rotor_speeds();
    check_commands(log_);
    log_.w_B = take_vector({"p", "q", "r"});
    log_.f_B = take_vector({"ax", "ay", "az"});
    log_.x_W = take_vector({"x", "y", "z"});
    log_.v_W = take_vector({"vx", "vy", "vz"});
    log_.q_WB = take_attitude(table_, log_);
    log_.vbat = column("vbat");
    if (vehicle_.battery_voltage) check_voltage(log_, columns_.header_line, *vehicle_.battery_voltage);
    log_.current = column("current");
    check_sensors();
    for (const Sensor& sensor : {Sensor{"attitude", log_.q_WB}, {"x y z", log_.x_W}, {"vx vy vz", log_.v_W}})
      if (!sensor.components.front().empty()) split_at_jumps(log_, sensor.components, sensor.name);
    if (table_.find("qw")) check_quaternion(log_, columns_.header_line);
    turn_axes();
    judge();
    return std::move(log_);
  }

 private:
  Rows column(const std::string& name) const {
    const Rows* values = table_.find(name);
    return values ? *values : Rows();
  }

  /// Three components; one that the file does not have is NaN where another one is there.
  std::array<Rows, 3> take_vector(const std::array<const char*, 3>& names) {
    std::array<Rows, 3> vector = {column(names[0]), column(names[1]), column(names[2])};
    if (std::ranges::all_of(vector, [](const Rows& c) { return c.empty(); })) return vector;
    for (std::size_t i = 0; i < 3; ++i)
      if (vector[i].empty()) {
        vector[i].assign(table_.rows(), kNaN);
        log_.warnings.push_back(
            {"missing_component", fmt::format("{}: {}: the column is missing or empty, the others "
                                              "of its group are there",
                                              log_.file, names[i])});
      }
    return vector;
  }

  /// The command of a row without one is the last one given.
  static Rows held(Rows values) {
    const auto first = std::ranges::find_if(values, [](double v) { return !std::isnan(v); });
    double last = first == values.end() ? kNaN : *first;
    for (double& value : values) last = value = std::isnan(value) ? last : value;
    return values;
  }

  void take_commands() {
    const bool normalised = columns_.commands > 0;
    const int n = normalised ? columns_.commands : columns_.pulses;
    if (normalised && columns_.pulses > 0)
      log_.notices.push_back(log_.file + ": commands are there twice; delta1.. is used, u1.. is not");
    std::vector<std::vector<double>> delta;
    for (int i = 1; i <= n; ++i) {
      const Rows given = column(fmt::format("{}{}", normalised ? "delta" : "u", i));
      given_.push_back(given);
      Rows values = held(given);
      if (values.empty()) return;
      if (!normalised)
        for (double& u : values)
          u = (u - vehicle_.command->min_us) / (vehicle_.command->max_us - vehicle_.command->min_us);
      delta.push_back(std::move(values));
    }
    log_.delta = std::move(delta);
    warn_of_range();
  }

  void warn_of_range() {
    double low = 0.0, high = 0.0;
    for (const Rows& values : log_.delta)
      for (const double d : values) low = std::min(low, d), high = std::max(high, d);
    if (low < -0.5 || high > 1.5)
      log_.warnings.push_back(
          {"command_range", fmt::format("{}: commands run from {:.3g} to {:.3g} of the range 0 to 1: "
                                        "is the vehicle's 'command' range right?",
                                        log_.file, low, high)});
  }

  void take_rotor_speeds() {
    std::vector<std::vector<double>> Omega;
    for (int i = 1; i <= columns_.speeds; ++i) {
      Rows values = column(fmt::format("omega{}", i));
      if (values.empty()) return;
      Omega.push_back(std::move(values));
    }
    if (!Omega.empty()) check_rotor_speeds(log_, Omega);
    if (Omega.empty() || Omega.front().empty()) return;
    drop_held(log_, Omega, "rotor speeds");
    drop_spikes(log_, Omega, "rotor speeds");
    log_.Omega = std::move(Omega);
  }

  struct Sensor {
    const char* name;
    Components components;
  };

  std::vector<Sensor> sensors() {
    return {{"p q r", log_.w_B},
            {"ax ay az", log_.f_B},
            {"attitude", log_.q_WB},
            {"x y z", log_.x_W},
            {"vx vy vz", log_.v_W}};
  }

  void check_sensors() {
    std::vector<NamedSensor> found;
    for (const Sensor& sensor : sensors()) {
      drop_constant(log_, sensor.components, sensor.name);
      if (sensor.components.front().empty()) continue;
      drop_held(log_, sensor.components, sensor.name);
      drop_frozen(log_, sensor.components, sensor.name);
      if (sensor.components.size() == 3) drop_spikes(log_, sensor.components, sensor.name);
      found.push_back({sensor.name, sensor.components});
    }
    if (log_.has_commands()) {
      drop_impossible(log_, log_.delta, "commands");
      found.push_back({"commands", given_});
    }
    if (log_.has_rotor_speeds()) found.push_back({"rotor speeds", log_.Omega});
    tell_rates(log_, found);
  }

  static void turn(std::array<Rows, 3>& vector, const Eigen::Matrix3d& C) {
    if (C.isIdentity()) return;
    std::array<Rows, 3> turned = vector;
    for (Eigen::Index to = 0; to < 3; ++to)
      for (Eigen::Index from = 0; from < 3; ++from) {
        if (C(to, from) == 0.0) continue;
        turned[static_cast<std::size_t>(to)] = vector[static_cast<std::size_t>(from)];
        for (double& value : turned[static_cast<std::size_t>(to)]) value *= C(to, from);
      }
    vector = std::move(turned);
  }

  void turn_axes() {
    turn(log_.w_B, to_frd(map_.body));
    turn(log_.f_B, to_frd(map_.body));
    turn(log_.x_W, to_ned(map_.world));
    turn(log_.v_W, to_ned(map_.world));
    turn_attitude(log_, map_.body, map_.world);
  }

  void judge() {
    check_specific_force(log_, columns_.header_line, vehicle_.g);
    check_rates_against_attitude(log_, columns_.header_line, table_.find("qw") != nullptr);
    check_velocity_axes(log_, columns_.header_line, to_frd(map_.body) * to_ned(map_.world).transpose());
    if (content_ == LogContent::motion) {
      if (!log_.has_attitude()) throw DataError(log_.file + ": attitude holds no usable value");
      return;
    }
    const bool moves =
        log_.has_rates() || log_.has_specific_force() || log_.has_attitude() || log_.has_velocity();
    if (!moves)
      throw DataError(log_.file + ": rates, specific force, attitude and velocity hold no usable value");
    if (!log_.has_commands() && !log_.has_rotor_speeds())
      throw DataError(log_.file + ": commands and rotor speeds hold no usable value");
    const Rows& z = log_.x_W[2];
    const auto below =
        std::ranges::count_if(z, [&](double value) { return value > vehicle_.ground_z + 0.5; });
    if (below * 2 > static_cast<long>(z.size()) && !z.empty())
      log_.warnings.push_back(
          {"below_ground", log_.file + ": z: mostly below the ground; z points down here: a file "
                                       "whose z points up needs a map with 'frames: {world: enu}'"});
  }

  // In the time of the log, or from its beginning where that is what times count from.
  void take_windows() {
    const auto meets = [&](double from, double to) { return from <= log_.t.back() && to >= log_.t.front(); };
    if (first_ != 0)
      for (auto& window : map_.windows)
        if (!meets(window[0], window[1])) window[0] -= first_, window[1] -= first_;
    for (const auto& window : map_.windows) {
      const double from = window[0], to = window[1];
      const auto rows = std::ranges::count_if(log_.t, [&](double t) { return t >= from && t <= to; });
      if (rows < 2)
        throw InputError(map_.file, map_.windows_line, "windows",
                         fmt::format("[{}, {}] holds {} rows of {}, which runs from {:.6g} to {:.6g} s", from,
                                     to, rows, log_.file, log_.t.front(), log_.t.back()));
    }
    log_.windows = map_.windows;
    log_.windows_found = !map_.windows.empty() && map_.windows_line == 0;
  }

  // What sensors showed outside the windows says nothing of flight: neither of their noise nor of their
  // times. Commands stay, for motors follow those from before, and so does the battery.
  void leave_out_ground() {
    if (log_.windows.empty()) return;
    std::vector<bool> used(log_.rows(), false);
    for (const auto& [from, until] : windows_off_ground(log_))
      for (std::size_t i = 0; i < log_.rows(); ++i)
        if (log_.t[i] >= from && log_.t[i] <= until) used[i] = true;
    for (auto& column : table_.columns) {
      const std::string& name = column.name;
      if (name == "t" || name == "vbat" || name == "current" || name.starts_with("delta") ||
          highest_number({name}, "u") > 0)
        continue;
      for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i]) column.values[i] = kNaN;
    }
  }

  NumberTable table_;
  const Vehicle& vehicle_;
  LogContent content_;
  LogMap map_;
  const LogColumns& columns_;
  double first_;
  std::vector<Rows> given_;  ///< commands before they were held: at their own rate
  FlightLog log_;
};

FlightLog build(NumberTable table, const Vehicle& vehicle, const std::optional<LogMap>& map,
                const LogColumns& columns, LogContent content) {
  TableSchema schema{.kind = "flight log", .required = {{{"t"}}}};
  for (const LogSignal& s : log_signals(kMostRotors)) schema.signals.push_back(s.signal);
  drop_empty_columns(table, schema);
  expect_plausible(table, schema, columns.header_line);
  std::vector<double> breaks = put_time_in_order(table);
  const double first = count_from_begin(table, breaks);
  return Builder(std::move(table), vehicle, map, content, columns, std::move(breaks), first).run();
}

FlightLog from_csv(const std::string& path, const Vehicle& vehicle, const std::optional<LogMap>& map,
                   LogContent content) {
  refuse_no_log(first_bytes(path, kRecognisedFrom), path);
  CsvReader csv(path);
  const std::optional<LogMap> used = map ? map : map_for_header(csv.header());
  LogColumns columns = choose_log_columns(path, csv, vehicle, used, content);
  if (used && !map) columns.notices.push_back(path + ": read by the " + used->file);
  return build(read_columns(path, csv, columns.columns, {}), vehicle, used, columns, content);
}

FlightLog from_streams(const LogStreams& log, const Vehicle& vehicle, const std::optional<LogMap>& map,
                       LogContent content) {
  StreamTable streams = make_stream_table(log, vehicle, map_for_log(log, map), content);
  FlightLog flight = build(std::move(streams.table), streams.vehicle, streams.map, streams.columns, content);
  flight.loop = flight.has_commands() ? streams.loop : 0.0;
  flight.each_command = flight.has_commands() && streams.each_command;
  return flight;
}

}  // namespace

FlightLog read_flight_log(const std::string& path, const Vehicle& vehicle, const std::optional<LogMap>& map) {
  if (log_format_of_file(path).empty()) return from_csv(path, vehicle, map, LogContent::flight);
  LogStreams log = read_log_streams(path);
  add_rebuilt_commands(log);
  return flight_log_of(log, vehicle, map);
}

FlightLog flight_log_of(const LogStreams& log, const Vehicle& vehicle, const std::optional<LogMap>& map) {
  return from_streams(log, vehicle, map, LogContent::flight);
}

FlightLog read_motion(const std::string& path, const std::optional<LogMap>& map) {
  if (log_format_of_file(path).empty()) return from_csv(path, Vehicle{}, map, LogContent::motion);
  return from_streams(read_log_streams(path), Vehicle{}, map, LogContent::motion);
}

}  // namespace ident
