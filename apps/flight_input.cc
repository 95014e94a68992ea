// Reads the logs and the vehicle of a flight command.
#include "flight_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <span>
#include <utility>

#include "campaign_priors.h"
#include "ident/core/parallel.h"
#include "ident/core/stage_times.h"
#include "ident/flight/checks/never_flew.h"
#include "ident/flight/join/join_motion.h"
#include "ident/io/file/sha256.h"
#include "ident/io/log/log_map.h"
#include "ident/io/log/read_flight_log.h"
#include "ident/io/simulators/logged_speeds.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_read.h"
#include "ident/io/vehicle/vehicle_write.h"

namespace ident::app {
namespace {

bool same_samples(std::span<const std::vector<double>> a, std::span<const std::vector<double>> b) {
  return std::ranges::equal(a, b, [](const std::vector<double>& x, const std::vector<double>& y) {
    return std::ranges::equal(x, y,
                              [](double v, double w) { return v == w || (std::isnan(v) && std::isnan(w)); });
  });
}

bool same_flight(const FlightLog& a, const FlightLog& b) {
  return a.t == b.t && a.windows == b.windows && same_samples(a.w_B, b.w_B) && same_samples(a.f_B, b.f_B) &&
         same_samples(a.v_W, b.v_W) && same_samples(a.q_WB, b.q_WB) && same_samples(a.delta, b.delta) &&
         same_samples(a.Omega, b.Omega);
}

/// What is given twice would count twice, and be held out against itself.
void refuse_twice(const std::vector<FlightLog>& logs) {
  const FlightLog& last = logs.back();
  for (const FlightLog& log : std::span(logs).first(logs.size() - 1))
    if (same_flight(log, last))
      throw UsageError(last.file + " holds the same flight as " + log.file + ": give each flight once");
}

std::optional<LogMap> map_in(const std::string& file) {
  if (file.empty()) return std::nullopt;
  return read_log_map(file);
}

FlightLog read_one(const CampaignLog& log, const Vehicle& vehicle) {
  FlightLog flight = read_flight_log(log.file, vehicle, map_in(log.map));
  if (log.motion.empty()) return flight;
  return with_motion(std::move(flight), read_motion(log.motion, map_in(log.motion_map)));
}

/// All at once; of what is wrong with several of them, the first is told.
std::vector<FlightLog> read_all(const std::vector<CampaignLog>& logs, const Vehicle& vehicle) {
  std::vector<FlightLog> read(logs.size());
  std::vector<std::exception_ptr> wrong(logs.size());
  in_parallel(logs.size(), [&](std::size_t i) {
    try {
      read[i] = read_one(logs[i], vehicle);
    } catch (...) {
      wrong[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& one : wrong)
    if (one) std::rethrow_exception(one);
  return read;
}

/// Of maps that are given once, or once for each of the files.
std::string map_of(const std::vector<std::string>& maps, const char* option, std::size_t files,
                   std::size_t file) {
  if (maps.empty()) return {};
  if (maps.size() == 1) return maps.front();
  if (maps.size() != files)
    throw UsageError(
        fmt::format("{} is given {} times for {} log{}: one map for all of them, or one for each", option,
                    maps.size(), files, files == 1 ? "" : "s"));
  return maps[file];
}

std::vector<CampaignLog> logs_of(const FlightOptions& options) {
  const std::size_t files = options.files.size();
  for (const auto& [option, given] : {std::pair("--map", &options.maps), {"--motion", &options.motions}})
    if (files == 0 && !given->empty())
      throw UsageError(std::string(option) +
                       " is for the logs that stand beside it: those of ident.yaml name theirs there");
  if (!options.motions.empty() && options.motions.size() != files)
    throw UsageError(fmt::format("--motion is given {} times for {} log{}: one recording for each",
                                 options.motions.size(), files, files == 1 ? "" : "s"));
  if (options.motions.empty() && !options.motion_maps.empty())
    throw UsageError("--motion-map is for the recordings of --motion: there are none");
  std::vector<CampaignLog> logs;
  for (std::size_t i = 0; i < files; ++i) {
    logs.push_back({options.files[i], map_of(options.maps, "--map", files, i)});
    if (options.motions.empty()) continue;
    logs.back().motion = options.motions[i];
    logs.back().motion_map = map_of(options.motion_maps, "--motion-map", files, i);
  }
  return logs;
}

}  // namespace

void add_flight_options(CLI::App& cli, FlightOptions& options) {
  cli.add_option("LOG", options.files, "flight logs (CSV); none: those of ident.yaml")->type_name("LOG");
  cli.add_option("--vehicle", options.vehicle, "vehicle file; none: that of ident.yaml")->type_name("FILE");
  cli.add_option("--params", options.params, "parameter file, laid over the vehicle file")->type_name("FILE");
  cli.add_option("--map", options.maps,
                 "which column is which signal, in which unit and frame; given once, or once for each log")
      ->type_name("FILE")
      ->allow_extra_args(false);
  cli.add_option("--motion", options.motions,
                 "motion capture of the same flight in a file of its own, once for each log")
      ->type_name("FILE")
      ->allow_extra_args(false);
  cli.add_option("--motion-map", options.motion_maps, "as --map, for the files of --motion")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

FlightInput flight_input(const FlightOptions& options, Model model, Context& context) {
  const Stage stage("read files");
  FlightInput input;
  const std::optional<Campaign> campaign = find_campaign();
  std::vector<CampaignLog> logs = logs_of(options);
  if (logs.empty() && campaign) {
    logs = campaign->logs;
    input.campaign = campaign;
  }
  if (!options.vehicle.empty()) {
    input.vehicle = read_vehicle(options.vehicle);
    input.campaign.reset();  // another vehicle is none of its business
    context.used.push_back(options.vehicle);
  } else if (campaign) {
    if (model == Model::as_stored) {
      input.vehicle = campaign_vehicle(*campaign);
    } else {
      CampaignPriors priors = before_logs(*campaign, logs);
      input.vehicle = std::move(priors.vehicle);
      input.warnings = std::move(priors.warnings);
      input.history = std::move(priors.history);
      context.notices.insert(context.notices.end(), priors.notices.begin(), priors.notices.end());
    }
    context.used.insert(context.used.end(), {campaign->file, campaign->vehicle, campaign->parameters});
    context.shown = Shown::pictures;  // the result is kept for the report of the campaign
  } else {
    throw UsageError("no vehicle: name one with --vehicle FILE, or run where there is an ident.yaml");
  }
  if (!options.params.empty()) {
    input.vehicle = with_parameters(input.vehicle, read_vehicle(options.params));
    context.used.push_back(options.params);
  }
  if (logs.empty()) throw UsageError("no flight log: name one, or list `logs` in ident.yaml");
  for (const CampaignLog& log : logs) {
    for (const std::string* used : {&log.map, &log.motion, &log.motion_map})
      if (!used->empty()) context.used.push_back(*used);
    std::error_code unreadable;                                  // which the reader tells
    if (std::filesystem::is_regular_file(log.file, unreadable))  // a pipe can be read only once
      context.hashes.try_emplace(log.file, std::async(std::launch::async, sha256_of_file, log.file));
  }
  for (FlightLog& log : read_all(logs, input.vehicle)) {
    input.logs.push_back(std::move(log));
    refuse_twice(input.logs);
    for (const std::string& notice : input.logs.back().notices) context.notices.push_back(notice);
  }
  if (!options.vehicle.empty() && assumes_rotor_speeds(options.vehicle))
    input.vehicle = with_logged_speeds(std::move(input.vehicle), input.logs);
  return input;
}

void leave_out_unflown(FlightInput& input, Context& context) {
  std::vector<FlightLog> flown;
  std::string first;
  for (FlightLog& log : input.logs) {
    const std::string why = never_flew(log, input.vehicle);
    if (why.empty()) {
      flown.push_back(std::move(log));
      continue;
    }
    if (first.empty()) first = why;
    context.notices.push_back(why + "; it is left out");
  }
  if (flown.empty()) throw DataError(first);
  input.logs = std::move(flown);
}

}  // namespace ident::app
