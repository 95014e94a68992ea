// Names, units and scales of blackbox fields, as `blackbox_decode` prints them by default.
#pragma once

#include <string_view>
#include <vector>

#include "ident/io/blackbox/column_store.h"
#include "ident/io/blackbox/header.h"

namespace ident::blackbox {

/// `Betaflight 4.2.11 (948ba6339) STM32F7X2` of the line `Firmware revision`.
struct Firmware {
  std::string_view name;  ///< `Betaflight`, `INAV`, `EmuFlight`, ...; empty where it is not stated
  int version = 0;        ///< 40211 for 4.2.11
};
Firmware firmware_of(const Header& header);

/// Columns of main frames. `vbatLatest (V)` has the scale of blackbox_decode: 0.01 from Betaflight 4.3 and
/// 0.1 before, though Betaflight 4.0 to 4.2 log 0.01 V as well.
std::vector<ColumnKind> main_columns(const Header& header);
std::vector<ColumnKind> slow_columns(const Header& header);
std::vector<ColumnKind> gps_columns(const Header& header);

}  // namespace ident::blackbox
