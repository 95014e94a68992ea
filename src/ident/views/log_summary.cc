// Writes the ten lines.
#include "ident/views/log_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ident/result/result.h"
#include "ident/views/log_advice.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

/// s from the first to the last sample; what was sampled before the log began, and is kept in it, does not
/// count.
double length_of(const LogStreams& log) {
  double first = INFINITY, last = -INFINITY;
  for (const LogStream& stream : log.streams)
    for (const double t : stream.t)
      if (t >= 0) first = std::min(first, t), last = std::max(last, t);
  return last > first ? last - first : 0.0;
}

std::string firmware(const LogStreams& log) {
  for (const char* name : {"firmware", "Firmware revision", "ver_sw_release", "sys_name"})
    if (const auto at = log.facts.find(name); at != log.facts.end()) return at->second;
  return "";
}

double seconds_in_air(const FlightLog& flight) {
  if (flight.windows.empty()) return flight.t.back() - flight.t.front();
  double sum = 0;
  for (const auto& [from, until] : flight.windows) sum += until - from;
  return sum;
}

// " (15.8 to 70.8 s)", in the time that windows of a map are stated in.
std::string when_in_air(const FlightLog& flight) {
  if (flight.windows.empty()) return " (takeoff and landing are not logged: all of the log)";
  std::vector<std::string> parts;
  for (const auto& [from, until] : flight.windows)
    parts.push_back(fmt::format("{:.1f} to {:.1f}", from, until));
  constexpr std::size_t kShown = 4;
  const std::size_t more = parts.size() > kShown ? parts.size() - kShown : 0;
  parts.resize(parts.size() - more);
  return fmt::format(" ({} s{})", fmt::join(parts, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

struct NamedRate {
  const char* name;
  double hz;
};
std::array<NamedRate, 8> named(const SignalRates& rates) {
  return {{{"commands", rates.commands},
           {"rotor speeds", rates.speeds},
           {"rates", rates.rates},
           {"specific force", rates.specific_force},
           {"attitude", rates.attitude},
           {"velocity", rates.velocity},
           {"position", rates.position},
           {"voltage", rates.battery}}};
}

void tell_flight(const LogStreams& log, const FlightLog& flight, std::vector<std::string>& lines,
                 Json& json) {
  const SignalRates rates = signal_rates(flight);
  const LogAdvice advice = advise(log, rates, motion_of(flight));
  std::vector<std::string> there, missing;
  json["rates_hz"] = Json::object();
  for (const auto& [name, hz] : named(rates)) {
    if (hz > 0)
      there.push_back(fmt::format("{} {:.3g} Hz", name, hz));
    else
      missing.emplace_back(name);
    json["rates_hz"][name] = hz > 0 ? Json(hz) : Json(nullptr);
  }
  json["seconds_in_air"] = seconds_in_air(flight);
  json["can_identify"] = advice.can;
  json["cannot_identify"] = advice.cannot;
  json["setting"] = advice.setting;
  json["movement"] = advice.movement;
  lines.push_back(fmt::format("in the air: {:.1f} s{}, {} motors", seconds_in_air(flight),
                              when_in_air(flight), std::max(flight.delta.size(), flight.Omega.size())));
  lines.push_back(fmt::format("signals:    {}", fmt::join(there, ", ")));
  if (!missing.empty()) lines.push_back(fmt::format("not logged: {}", fmt::join(missing, ", ")));
  if (const auto at = log.facts.find("commands"); at != log.facts.end()) {
    lines.push_back("commands:   " + at->second);
    json["commands"] = at->second;
  }
  lines.push_back("moved:      " + advice.movement);
  lines.push_back(fmt::format("can tell:   {}", fmt::join(advice.can, "; ")));
  lines.push_back(fmt::format("cannot:     {}", fmt::join(advice.cannot, "; ")));
  lines.push_back("next time:  " + (advice.setting.empty() ? "nothing to change" : advice.setting));
}

}  // namespace

LogSummary summarise_log(const LogStreams& log, const std::optional<FlightLog>& flight,
                         const std::string& why) {
  LogSummary summary;
  std::vector<std::string> lines;
  const double length = length_of(log);
  summary.json["format"] = log.format;
  summary.json["seconds"] = length;
  summary.json["parameters_in_log"] = log.parameters.size();
  summary.json["stream_count"] = log.streams.size();
  lines.push_back(fmt::format("{}: {}{}, {} streams, {} parameters, {:.1f} s", log.file, log.format,
                              firmware(log).empty() ? "" : ", " + firmware(log), log.streams.size(),
                              log.parameters.size(), length));
  if (flight)
    tell_flight(log, *flight, lines, summary.json);
  else
    lines.push_back("no flight:  " + why);
  double lost = 0;
  for (const auto& [from, until] : log.dropouts) lost += until - from;
  if (lost > 0)
    lines.push_back(
        fmt::format("lost:       {:.2f} s in {} dropouts of the logger", lost, log.dropouts.size()));
  summary.json["damage"] = log.damage;
  if (!log.damage.empty()) lines.push_back("damaged:    " + log.damage.front());
  summary.text = fmt::format("{}\n", fmt::join(lines, "\n"));
  return summary;
}

std::string streams_table(const LogStreams& log) {
  std::string text;
  for (const LogStream& stream : log.streams) {
    const double span = stream.t.size() < 2 ? 0.0 : stream.t.back() - stream.t.front();
    std::vector<std::string> fields;
    for (const StreamField& field : stream.fields) fields.push_back(field.name);
    text += fmt::format(
        "{:<36} {:>8} samples {:>9}  {}\n", stream.name, stream.t.size(),
        span > 0 ? fmt::format("{:.1f} Hz", static_cast<double>(stream.t.size() - 1) / span) : "-",
        fmt::join(fields, " "));
  }
  return text;
}

}  // namespace ident
