// Scales of blackbox fields that follow from several header lines, as parameters of the log.
#pragma once

#include "ident/io/blackbox/header.h"

namespace ident {
struct LogStreams;
}

namespace ident::blackbox {

/// Adds, where the firmware is one of which they are known:
///   ident_gyro_scale        deg/s in a unit of gyroADC and gyroUnfilt
///   ident_debug_gyro_scale  the same of debug[0..2], where these are the unfiltered rates (debug_mode
///   GYRO_SCALED) ident_vbat_scale        V in a unit of the column `vbatLatest (V)`
///   ident_loop_hz           of the controller
///   ident_acc_lag, _square  s and s^2, of the low-pass before accSmooth
///   ident_gyro_lag, _square the same of both low-passes before gyroADC; of one whose cutoff follows the
///   throttle in the middle of its range. Notches are not counted.
/// Parameters stand for the first log of a file that can be read.
void add_derived_settings(const Header& header, LogStreams& streams);

}  // namespace ident::blackbox
