// Warnings about one sweep.
#include "ident/bench/thrust/thrust_sweep_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/format_number.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

class Sayer {
 public:
  Sayer(const SweepFile& file, std::vector<Warning>& warnings) : file_(file), warnings_(warnings) {}
  template <class... Args>
  void operator()(const char* code, fmt::format_string<Args...> text, Args&&... args) {
    warnings_.push_back({code, file_.rows.file + ": " + fmt::format(text, std::forward<Args>(args)...)});
  }

 private:
  const SweepFile& file_;
  std::vector<Warning>& warnings_;
};

bool shares_a_row(const SweepRows& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::isfinite(rows.thrust[i]) && std::isfinite(rows.torque[i])) return true;
  return false;
}

void about_rows(const SweepFile& file, Sayer& say) {
  const SweepRows& rows = file.rows;
  if (!rows.torque.empty() && !shares_a_row(rows))
    say("separate_rows",
        "thrust and torque never stand in the same row; each is fitted with the speed of its own");
  if (const auto n = std::ranges::count(rows.at_rest, true); n > 0)
    say("rows_at_rest", "{} rows at rest set the tare", n);
  if (rows.doubtful_rest > 0)
    say("rows_at_rest",
        "{} rows show speed 0 but may turn below what the sensor sees (idle thrust); they are left out. "
        "Three rows "
        "at rest on end, or a command column, would settle the tare",
        rows.doubtful_rest);
  if (rows.missed > 0)
    say("speed_missed",
        "{} rows show speed 0 at commands at which the rotor turns elsewhere: the sensor of '{}' missed it; "
        "they "
        "are left out",
        rows.missed, rows.speed_column);
  if (file.points.ramp)
    say("averaged_ramp",
        "the speed stays at no set-point: {} rows are taken as {} means of neighbours, over which noise of "
        "the "
        "speed averages out",
        file.points.thrust.used, file.points.thrust.moving.size());
  if (rows.spikes + file.fit.speed_outliers > 0)
    say("speed_spikes", "{} readings of '{}' stand out of their neighbours and are not used",
        rows.spikes + file.fit.speed_outliers, rows.speed_column);
  if (rows.filled > 0)
    say("speed_interpolated", "{} rows without a speed take it from the rows around them", rows.filled);
  if (std::isfinite(file.points.lag))
    say("no_steady_rows",
        "the speed never stays: the fit uses the squared speed through a lag of {} s, which fits best. Steps "
        "of "
        "3 s or more are better than ramps",
        format_number(file.points.lag, 2));
  if (rows.is_log && !std::isfinite(file.points.lag))
    say("transients_excluded",
        "{} of {} rows with thrust are at steady speed and used; the others lie in or "
        "shortly after a change of speed",
        file.points.thrust.used, file.points.thrust.rows);
}

void about_channel(const SweepFile& file, const SweepChannel& channel, const ChannelResiduals& residuals,
                   Sayer& say) {
  if (channel.moving.empty()) return;
  if (channel.reversed)
    say(channel.name == "thrust" ? "reversed_thrust" : "reversed_torque",
        "{} falls with rising speed: its sign is turned round (the sensor is mounted or zeroed the other "
        "way)",
        channel.name);
  const Parameter tare = fitted_parameter(file.fit.fit, channel.name + "_tare", channel.unit, "thrust");
  const double share = 100.0 * std::fabs(tare.value) / channel.full_scale();
  if ((tare.ci95[0] > 0.0 || tare.ci95[1] < 0.0) && share > 0.1)
    say("tare_offset", "{} reads {} {} at rest{} ({:.1f} % of full scale); taken off", channel.name,
        format_with_uncertainty(tare.value, tare.std), channel.unit,
        channel.rest.empty() ? ", extrapolated from the rows in motion" : "", share);
  if (channel.rest.size() >= 2 && std::isfinite(channel.rest_std)) {
    const auto [low, high] = std::ranges::minmax(channel.rest);
    if (channel.drifts && high - low > 0.005 * channel.full_scale())
      say("tare_drift",
          "{} at rest changes from {} to {} {} over the file: its drift is taken off as linear from one stay "
          "at "
          "rest to the next",
          channel.name, format_number(channel.rest.front(), 3), format_number(channel.rest.back(), 3),
          channel.unit);
  }
  if (const auto n = std::ranges::count(residuals.rejected, true); n > 0)
    say("outliers", "{} of {} {} points are left out as outliers", n, residuals.rejected.size(),
        channel.name);
}

/// Two speeds, or one and rest: any law with two constants fits.
void about_speeds(const SweepFile& file, Sayer& say) {
  std::vector<double> speeds;
  for (const SweepPoint& p : file.points.thrust.moving) speeds.push_back(p.Omega);
  if (!file.points.thrust.rest.empty()) speeds.push_back(0.0);
  std::ranges::sort(speeds);
  int different = 1;
  for (double last = speeds.front(); const double speed : speeds)
    if (speed - last > 0.02 * speeds.back()) ++different, last = speed;
  if (different < 3)
    say("few_speeds",
        "only {} different speeds: tare and k Omega^2 fit such data whatever the law is. Take five or more",
        different);
}

void about_law(const LawJudgement& law, const std::string& what, Sayer& say) {
  if (!law.law_fails) return;
  say("quadratic_law_misfit",
      "{}: k Omega^2 misses {:.2f} % of full scale, a + b Omega + c Omega^2 {:.2f} % (p = {:.1g}): the "
      "constant "
      "depends on the speed at which it is used",
      what, law.misfit_percent_fs, law.with_linear_term_percent_fs, law.p_value);
}

void about_speed(const SweepFile& file, Sayer& say) {
  const double top = std::ranges::max(file.points.thrust.moving, {}, &SweepPoint::Omega).Omega;
  if (file.fit.speed_modelled) {
    const double bias = speed_noise_bias(file.points.thrust, file.fit.speed_noise);
    if (std::fabs(bias) > 0.001 && file.fit.speed_share < 0.5)
      say("speed_noise",
          "readings of the speed scatter by {} rad/s at a set-point: without allowing for it kT would be "
          "{:+.1f} "
          "% off",
          format_number(file.fit.speed_noise, 2), 100.0 * bias);
    return;
  }
  const bool repeated =
      file.points.averaged || file.rows.set_points < static_cast<int>(file.points.thrust.moving.size());
  if (!repeated)
    say("speed_noise_unknown",
        "no set-point is repeated, so the noise of the speed cannot be told; 1 % of full speed ({} rad/s) "
        "would make kT "
        "{:+.2f} % off. Take three rows or more at each command",
        format_number(0.01 * top, 2), 100.0 * speed_noise_bias(file.points.thrust, 0.01 * top));
}

void about_command(const SweepFile& file, Sayer& say) {
  if (file.rows.pulse_without_range)
    say("command_range_unknown",
        "pulse widths without `command: {{min, max}}` of a vehicle file give no command curve (--vehicle)");
  if (file.command_falls)
    say("command_reversed", "the speed falls with rising command: no command curve; check that column");
  if (file.curve && file.curve->is_bent)
    say("command_curve_bent",
        "speed over command is no straight line: it misses {:.1f} % of full speed, with a square {:.1f} %",
        file.curve->misfit_percent_fs, file.curve->with_square_percent_fs);
}

void about_motor(const SweepFile& file, Sayer& say) {
  if (!file.motor) return;
  if (!file.motor->missing.empty()) say("motor_not_identifiable", "motor constants: {}", file.motor->missing);
  if (file.motor->side && !file.motor->side_is_clear)
    say("current_side_unclear",
        "the data do not tell whether the current was measured before or behind the speed controller");
}

}  // namespace

void add_sweep_warnings(const SweepFile& file, std::vector<Warning>& warnings) {
  Sayer say(file, warnings);
  about_rows(file, say);
  about_channel(file, file.points.thrust, file.fit.thrust, say);
  about_channel(file, file.points.torque, file.fit.torque, say);
  about_speeds(file, say);
  about_law(file.thrust_law, "thrust", say);
  if (file.torque_law) about_law(*file.torque_law, "torque", say);
  about_speed(file, say);
  about_command(file, say);
  about_motor(file, say);
}

}  // namespace ident
