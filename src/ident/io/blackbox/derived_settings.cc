// Scales of blackbox fields that follow from several header lines, as parameters of the log.
#include "ident/io/blackbox/derived_settings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "ident/data/log_streams.h"
#include "ident/data/low_pass.h"
#include "ident/io/blackbox/field_units.h"

namespace ident::blackbox {

namespace {

/// A low-pass of Betaflight, `lowpassFilterType_e` of filter.h; cutoffs are where all stages together take
/// 3 dB [pt1FilterGain, pt2FilterGain, pt3FilterGain of filter.c].
LowPass low_pass(double type, double cutoff) {
  if (!(cutoff > 0)) return {};
  if (type == 1) return butterworth(cutoff);
  const int stages = type == 0 ? 1 : type == 2 ? 2 : type == 3 ? 3 : 0;
  const double per_cutoff = 1 / std::sqrt(std::pow(2.0, 1.0 / stages) - 1);
  const LowPass stage{.lag = 1 / (2 * std::numbers::pi * per_cutoff * cutoff)};
  LowPass all;
  for (int s = 0; s < stages; ++s) all = in_a_row(all, stage);
  return all;
}

/// The gyro's: their names before 4.3 and since.
LowPass gyro_low_pass(const LogStreams& streams) {
  const auto setting = [&](const char* before, const char* since) {
    const std::optional<double> named = streams.parameter(since);
    return (named ? named : streams.parameter(before)).value_or(0.0);
  };
  const double low = setting("gyro_lowpass_dyn_hz[0]", "gyro_lpf1_dyn_hz[0]"),
               high = setting("gyro_lowpass_dyn_hz[1]", "gyro_lpf1_dyn_hz[1]"),
               first = low > 0 ? (low + std::max(low, high)) / 2
                               : setting("gyro_lowpass_hz", "gyro_lpf1_static_hz");
  return in_a_row(low_pass(setting("gyro_lowpass_type", "gyro_lpf1_type"), first),
                  low_pass(setting("gyro_lowpass2_type", "gyro_lpf2_type"),
                           setting("gyro_lowpass2_hz", "gyro_lpf2_static_hz")));
}

void add(const std::string& name, const LowPass& filter, LogStreams& streams) {
  if (!(filter.lag > 0)) return;
  streams.parameters[name + "_lag"] = filter.lag, streams.parameters[name + "_square"] = filter.square;
}

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
  if (const auto loop = streams.parameter("looptime"); loop && *loop > 0)
    streams.parameters["ident_loop_hz"] =
        1e6 / *loop / std::max(1.0, streams.parameter("pid_process_denom").value_or(1));
  if (!betaflight || firmware.version < 40000) return;
  add("ident_gyro", gyro_low_pass(streams), streams);
  // In 0.01 Hz [blackbox.c]; a biquad up to 4.4, then PT2 [accelerometer_init.c].
  if (const auto cutoff = streams.parameter("acc_lpf_hz"))
    add("ident_acc", low_pass(firmware.version < 40500 ? 1 : 2, 0.01 * *cutoff), streams);
}

}  // namespace ident::blackbox
