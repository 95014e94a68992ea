// Names, units and scales of blackbox fields, as `blackbox_decode` prints them by default.
#include "ident/io/blackbox/field_units.h"

#include <charconv>
#include <string>

namespace ident::blackbox {

namespace {

struct Unit {
  std::string_view unit;
  double scale;
};

ColumnKind column(const std::string& name, Unit unit, Stored stored) {
  const std::string shown = unit.unit.empty() ? name : name + " (" + std::string(unit.unit) + ")";
  return {shown, unit.unit == "flags" ? std::string{} : std::string(unit.unit), unit.scale, stored};
}

Stored stored_as(const FrameDefinition& definition, std::size_t i) {
  return definition.is_signed[i] != 0 ? Stored::int32 : Stored::uint32;
}

}  // namespace

Firmware firmware_of(const Header& header) {
  const std::string_view text = header.value("Firmware revision");
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return {};
  Firmware firmware{.name = text.substr(0, space)};
  const char* at = text.data() + space + 1;
  const char* const end = text.data() + text.size();
  for (int part = 0; part < 3; ++part) {
    int number = 0;
    const auto [after, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || number < 0 || number > 99) return {.name = firmware.name};
    firmware.version = 100 * firmware.version + number;
    at = after < end && *after == '.' ? after + 1 : after;
  }
  return firmware;
}

std::vector<ColumnKind> main_columns(const Header& header) {
  const Firmware firmware = firmware_of(header);
  const double vbat_scale = firmware.name == "Betaflight" && firmware.version >= 40300 ? 0.01 : 0.1;
  std::vector<ColumnKind> columns;
  for (std::size_t i = 0; i < header.I.size(); ++i) {
    const std::string& name = header.I.names[i];
    if (i == 1)
      columns.push_back(column(name, {"us", 1.0}, Stored::int64));
    else if (name == "vbatLatest")
      columns.push_back(column(name, {"V", vbat_scale}, Stored::int32));
    else if (name == "amperageLatest")
      columns.push_back(column(name, {"A", 0.01}, Stored::int32));
    else if (name == "BaroAlt" || name == "baroAlt")
      columns.push_back(column(name, {"cm", 1.0}, Stored::int32));
    else
      columns.push_back(column(name, {"", 1.0}, stored_as(header.I, i)));
  }
  return columns;
}

std::vector<ColumnKind> slow_columns(const Header& header) {
  std::vector<ColumnKind> columns;
  for (const std::string& name : header.S.names) {
    const bool flags = name == "flightModeFlags" || name == "stateFlags" || name == "failsafePhase";
    columns.push_back(column(name, {flags ? "flags" : "", 1.0}, Stored::uint32));
  }
  return columns;
}

std::vector<ColumnKind> gps_columns(const Header& header) {
  std::vector<ColumnKind> columns;
  for (std::size_t i = 0; i < header.G.size(); ++i) {
    const std::string& name = header.G.names[i];
    if (name == "time")
      columns.push_back(column(name, {"us", 1.0}, Stored::int64));
    else if (name.starts_with("GPS_coord["))
      columns.push_back({name, "deg", 1e-7, Stored::int32});
    else if (name == "GPS_speed")
      columns.push_back(column(name, {"m/s", 0.01}, Stored::int32));
    else if (name == "GPS_ground_course")
      columns.push_back({name, "deg", 0.1, Stored::int32});
    else
      columns.push_back(column(name, {"", 1.0}, stored_as(header.G, i)));
  }
  return columns;
}

}  // namespace ident::blackbox
