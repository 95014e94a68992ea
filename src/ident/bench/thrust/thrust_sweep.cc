// Result of `ident thrust`: files analysed one by one, then together.
#include "ident/bench/thrust/thrust_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/bench/thrust/thrust_sweep_hover.h"
#include "ident/bench/thrust/thrust_sweep_parameters.h"
#include "ident/bench/thrust/thrust_sweep_plausible.h"
#include "ident/bench/thrust/thrust_sweep_sections.h"
#include "ident/bench/thrust/thrust_sweep_warnings.h"
#include "ident/core/error.h"
#include "ident/core/format_number.h"
#include "ident/core/statistics.h"
#include "ident/lsq/least_squares_result.h"

namespace ident {
namespace {

constexpr std::size_t kMostSections = 6;  // files with pictures of their own

using Files = std::vector<SweepFile>;
using Json = nlohmann::ordered_json;

Files analyse(const std::vector<NumberTable>& tables, const ThrustOptions& options, Result& result) {
  Files files;
  for (const NumberTable& table : tables) {
    result.inputs.push_back(table.file);
    result.warnings.insert(result.warnings.end(), table.warnings.begin(), table.warnings.end());
    try {
      files.push_back(analyse_sweep(table, options, result.warnings));
    } catch (const DataError& error) {
      if (tables.size() == 1) throw;
      result.warn("file_refused", error.what());
    }
  }
  if (files.empty()) throw DataError("none of the files tells kT: " + result.warnings.back().message);
  for (const SweepFile& file : files) add_sweep_warnings(file, result.warnings);
  return files;
}

Json estimate_json(const LeastSquaresFit& fit, const char* name) {
  const Parameter p = fitted_parameter(fit, name, "", "");
  return {{"value", p.value}, {"std", p.std}, {"ci95", {p.ci95[0], p.ci95[1]}}};
}

Json law_json(const LawJudgement& law) {
  return {{"misfit_percent_fs", law.misfit_percent_fs},
          {"with_linear_term_percent_fs", law.with_linear_term_percent_fs},
          {"noise_percent_fs", law.noise_percent_fs},
          {"full_scale", law.full_scale},
          {"p_value", law.p_value},
          {"law_fails", law.law_fails}};
}

Json file_json(const SweepFile& file) {
  Json json = {{"file", file.rows.file},
               {"kT", estimate_json(file.fit.fit, "kT")},
               {"thrust_tare", estimate_json(file.fit.fit, "thrust_tare")}};
  if (file.has_torque()) {
    json["kQ"] = estimate_json(file.fit.fit, "kQ");
    json["torque_tare"] = estimate_json(file.fit.fit, "torque_tare");
  }
  json["speed_column"] = file.rows.speed_column;
  json["points"] = file.points.thrust.moving.size();
  json["rows_used"] = file.points.thrust.used;
  json["noise_autocorrelation"] = file.fit.thrust.rho;
  if (file.fit.speed_modelled)
    json["speed"] = {{"noise", file.fit.speed_noise}, {"share_that_is_real", file.fit.speed_share}};
  json["thrust_law"] = law_json(file.thrust_law);
  if (file.torque_law) json["torque_law"] = law_json(*file.torque_law);
  return json;
}

/// Over all files: each point counts alike, relative to the full scale of its file.
void add_law(Result& result, const Files& files) {
  double quadratic = 0.0, linear = 0.0, noise = 0.0, points = 0.0, least_p = 1.0;
  bool fails = false;
  auto list = Json::array();
  for (const SweepFile& file : files) {
    const auto n = static_cast<double>(file.points.thrust.moving.size());
    const LawJudgement& law = file.thrust_law;
    quadratic += n * law.misfit_percent_fs * law.misfit_percent_fs;
    linear += n * law.with_linear_term_percent_fs * law.with_linear_term_percent_fs;
    noise += n * law.noise_percent_fs * law.noise_percent_fs;
    points += n;
    least_p = std::fmin(least_p, law.p_value);
    fails = fails || law.law_fails;
    Json entry = law_json(law);
    entry["file"] = file.rows.file;
    list.push_back(entry);
  }
  result.extra["quadratic_law"] = {{"misfit_percent_fs", std::sqrt(quadratic / points)},
                                   {"with_linear_term_percent_fs", std::sqrt(linear / points)},
                                   {"noise_percent_fs", std::sqrt(noise / points)},
                                   {"p_value", std::fmin(1.0, least_p * static_cast<double>(files.size()))},
                                   {"law_fails", fails},
                                   {"files", list}};
}

void add_fit(Result& result, const Files& files) {
  std::size_t samples = 0;
  std::vector<double> thrust, residual, torque_residual;
  for (const SweepFile& file : files) {
    samples += file.points.thrust.used + file.points.torque.used;
    for (std::size_t i = 0; i < file.fit.thrust.residual.size(); ++i) {
      if (file.fit.thrust.rejected[i]) continue;
      thrust.push_back(file.points.thrust.moving[i].value);
      residual.push_back(file.fit.thrust.residual[i]);
    }
    for (std::size_t i = 0; i < file.fit.torque.residual.size(); ++i)
      if (!file.fit.torque.rejected[i]) torque_residual.push_back(file.fit.torque.residual[i]);
  }
  result.fit["samples"] = samples;
  result.fit["r2"] = r_squared(thrust, residual);
  result.fit["rmse"]["thrust"] = root_mean_square(residual);
  if (!torque_residual.empty()) result.fit["rmse"]["torque"] = root_mean_square(torque_residual);
}

std::string verdict(const Result& result, const Files& files) {
  const Parameter& kT = *result.find("kT");
  std::string text = fmt::format("kT = {} {}", format_with_uncertainty(kT.value, kT.std), kT.unit);
  if (const Parameter* kQ = result.find("kQ"))
    text += fmt::format(", kQ = {} {}", format_with_uncertainty(kQ->value, kQ->std), kQ->unit);
  text += files.size() == 1 ? "." : fmt::format(", over {} files.", files.size());
  const Json& law = result.extra.at("quadratic_law");
  text += fmt::format(" The quadratic law misses {:.2f} % of full scale{}.",
                      law.at("misfit_percent_fs").get<double>(),
                      law.at("law_fails").get<bool>() ? ", more than the noise explains" : "");
  return text;
}

}  // namespace

ThrustOptions thrust_options(const Vehicle& vehicle) {
  ThrustOptions options{.command = vehicle.command, .radius = vehicle.propeller_radius};
  if (vehicle.air_density) options.rho = *vehicle.air_density;
  if (vehicle.has("m") && !vehicle.rotors.empty())
    options.hover_thrust = vehicle.value("m") * vehicle.g / static_cast<double>(vehicle.rotors.size());
  return options;
}

Result estimate_thrust(const std::vector<NumberTable>& tables, const ThrustOptions& options) {
  Result result{.command = "thrust"};
  const Files files = analyse(tables, options, result);
  add_sweep_parameters(result, files, options);
  warn_of_implausible(result, options);
  add_fit(result, files);
  add_law(result, files);
  auto list = Json::array();
  for (const SweepFile& file : files) list.push_back(file_json(file));
  result.extra["sweeps"] = list;
  Section summary{.title = "Thrust sweeps",
                  .text = "thrust = tare + kT Omega^2, torque = tare + kQ Omega^2.",
                  .tables = {sweep_table(files), law_table(files)}};
  add_hover(result, files, options, summary);
  result.sections.push_back(std::move(summary));
  for (std::size_t i = 0; i < std::min(files.size(), kMostSections); ++i)
    result.sections.push_back(sweep_section(files[i], i + 1));
  result.verdict = verdict(result, files);
  return result;
}

}  // namespace ident
