// What thrust sweeps, motor steps and pendulum files hold, with the spellings of common exports:
// RCbenchmark 15xx ("Motor Optical Speed (RPM)", "ESC signal (us)") and AutoQuad ESC32 logs ("Duty", "Batt.
// Volts").
#pragma once

#include "ident/io/csv/read_table.h"

namespace ident {

/// omega | omega_electrical | omega_optical, thrust; torque, delta, u, voltage, current, t.
/// `omega` is the file's plain rotor speed (`omega`, `rpm`). Exports that name electrical and optical speed
/// fill `omega_electrical` and `omega_optical` instead; which one to trust is for the estimator to find out.
TableSchema thrust_schema();

/// Time stamps may repeat (warning `time_repeated`), but do not go back.
TableSchema motor_schema();

/// std.
TableSchema pendulum_schema();

}  // namespace ident
