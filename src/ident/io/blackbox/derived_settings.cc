// Scales of blackbox fields that follow from several header lines, as parameters of the log.
#include "ident/io/blackbox/derived_settings.h"

#include "ident/data/log_streams.h"
#include "ident/io/blackbox/field_units.h"

namespace ident::blackbox {

namespace {

/// `debug_mode` of Betaflight 3 and 4: debug[0..2] are the rates before the filters, in deg/s.
constexpr double debug_gyro_scaled = 6;

}  // namespace

void add_derived_settings(const Header& header, LogStreams& streams) {
  const Firmware firmware = firmware_of(header);
  const bool betaflight = firmware.name == "Betaflight";
  // With blackbox_high_resolution rates are logged in 0.1 deg/s.
  const double resolution = streams.parameter("blackbox_high_resolution").value_or(0) > 0 ? 0.1 : 1.0;
  if (const auto scale = streams.parameter("gyro_scale"); scale && *scale > 0)
    streams.parameters["ident_gyro_scale"] = *scale * resolution;
  if (betaflight && firmware.version < 50000 && streams.parameter("debug_mode") == debug_gyro_scaled)
    streams.parameters["ident_debug_gyro_scale"] = 1.0;
  // Betaflight 4.0 to 4.2 log 0.01 V, which blackbox_decode takes for 0.1 V; before 4.0 it is 0.1 V.
  if (betaflight && firmware.version > 0)
    streams.parameters["ident_vbat_scale"] =
        firmware.version >= 40000 && firmware.version < 40300 ? 0.1 : 1.0;
}

}  // namespace ident::blackbox
