// What a log file holds, as stored: streams with their own times, parameters, and facts about the vehicle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ident {

/// Values of one field in the type in which the file stores them.
using StoredValues =
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int8_t>, std::vector<std::uint8_t>,
                 std::vector<std::int16_t>, std::vector<std::uint16_t>, std::vector<std::int32_t>,
                 std::vector<std::uint32_t>, std::vector<std::int64_t>, std::vector<std::uint64_t>>;

/// One field of a stream: `gyro_rad[0]`, `RollRate`.
struct StreamField {
  std::string name;
  std::string unit;    ///< as the file states it; empty where it does not
  double scale = 1.0;  ///< stored value times this is the value in the file's unit
  StoredValues values;

  std::size_t size() const {
    return std::visit([](const auto& v) { return v.size(); }, values);
  }
  /// Scaled value of a sample.
  double at(std::size_t i) const {
    return scale * std::visit([i](const auto& v) { return static_cast<double>(v[i]); }, values);
  }
};

/// One topic of a log, with the times at which it was sampled.
struct LogStream {
  std::string name;   ///< as the format calls it, instance included: `vehicle_attitude:0`, `RATE`, `1:main`
  std::string clock;  ///< field that `t` was made from; empty where times were counted
  /// s on the log's clock, which counts from the start of the log or of the autopilot. It goes back where the
  /// file is damaged or the clock was set.
  std::vector<double> t;
  std::vector<StreamField> fields;

  const StreamField* find(std::string_view field) const {
    for (const StreamField& f : fields)
      if (f.name == field) return &f;
    return nullptr;
  }
};

/// A parameter that was set while the log was being written.
struct ParameterChange {
  double t = 0.0;  ///< s on the log's clock
  std::string name;
  double value = 0.0;
};

/// A log as its file holds it. Readers fill this; profiles make a `FlightLog` of it.
struct LogStreams {
  std::string file;
  std::string format;  ///< `ulog`, `dataflash`, `blackbox`, ... as in log_formats.def
  std::vector<LogStream> streams;
  std::map<std::string, double> parameters;     ///< at the start of the log; numbers only
  std::map<std::string, std::string> facts;     ///< firmware, vehicle id, header lines, text parameters
  std::vector<std::array<double, 2>> dropouts;  ///< [from, until) s in which samples were lost
  std::vector<std::string> damage;              ///< what could not be read, with byte and reason
  std::vector<ParameterChange> parameter_changes;

  const LogStream* find(std::string_view name) const {
    for (const LogStream& s : streams)
      if (s.name == name) return &s;
    return nullptr;
  }
  /// A parameter that is a whole number of at most nine digits; empty for another value.
  std::optional<int> whole_parameter(const std::string& name) const {
    const std::optional<double> value = parameter(name);
    if (!value || !(*value > -1e9 && *value < 1e9)) return std::nullopt;
    return static_cast<int>(*value);
  }
  std::optional<double> parameter(const std::string& name) const {
    const auto at = parameters.find(name);
    return at == parameters.end() ? std::nullopt : std::optional<double>(at->second);
  }
};

}  // namespace ident
