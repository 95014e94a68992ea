// Estimates that no vehicle has.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "ident/result/result.h"

namespace ident {

/// Those of these names that a result has are not known, for that reason.
void doubt_all(Result& result, std::initializer_list<std::string_view> names, const std::string& why);

/// A dead time that is negative beyond chance, which no motor has.
bool is_before_its_command(const Parameter& p);

/// Warns (`negative_dead_time`) of such a one, which counts as not identifiable, nor does the rest of the
/// motors' lag, nor what the rotors' inertia takes part in.
void doubt_negative_dead_time(Result& result);

/// Warns (`negative_rotor_inertia`) of a Jp that is negative beyond chance: neither that nor Jzz and kQ count
/// as identifiable. Not for a vehicle whose file has the sign of the rotors' momentum as published.
void doubt_negative_rotor_inertia(Result& result);

/// After the warning `contradicted`: constants of motors and yaw do not count as identifiable.
void doubt_contradicted(Result& result);

/// Doubts the motors' constants and moments of inertia, with a warning, where motors come out far slower than
/// stated, if they are, and slower than any that fly: a fit that leaves the commands aside.
void doubt_motors_without_effect(Result& result);

/// Doubts the motors' lag and their offset where the self-test found that commands were logged in coarse
/// steps.
void doubt_coarse_commands(Result& result);

/// Where speeds are the input and rows are far apart, as the self-test found, what turns the vehicle between
/// them was not measured: its moments of inertia, and those of the rotors, are not known.
void doubt_seldom_speeds(Result& result);

/// A constant that flight does not tell, and yet draws far from what was stated of it, makes up for
/// something: those that are known only together with it do not count as known either; with Jp, neither do kQ
/// and Jzz.
void doubt_drawn_away(Result& result);

/// Where a fit predicts other flight worse than what was stated does, a warning `predicts_worse`: what it has
/// five deviations from there is not known.
void doubt_where_worse(Result& result, const std::string& how);

}  // namespace ident
