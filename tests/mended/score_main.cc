// Scores mended files: held-out prediction against the best model of the target, and flight of the true
// vehicle.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "best_model.h"
#include "closed_loop.h"
#include "options.h"

namespace {

using namespace mended;
using nlohmann::json;
namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

json as_json(const Errors& e, const Errors& unit) {
  return {{"velocity", e.v}, {"attitude", e.attitude}, {"rate", e.rate}, {"pooled", pooled(e, unit)}};
}

json as_json(const ClosedLoop& c) {
  return {{"crashed", c.crashed},
          {"until", c.until},
          {"rms", c.rms},
          {"steepest", c.steepest},
          {"by_reference", c.by_reference}};
}

json as_json(const TargetModel& m) {
  json out = {{"m", m.m},
              {"J", {m.J(0, 0), m.J(1, 1), m.J(2, 2), m.J(0, 1), m.J(0, 2), m.J(1, 2)}},
              {"c", {m.c.x(), m.c.y(), m.c.z()}},
              {"tau", {m.tau_up, m.tau_down}},
              {"low", m.low},
              {"full", m.full},
              {"kd", m.kd},
              {"kz", m.kz},
              {"kh", m.kh},
              {"k_flap", m.k_flap},
              {"momentum", m.momentum},
              {"c_D", {m.c_D.x(), m.c_D.y(), m.c_D.z()}},
              {"linear_drag", m.linear_drag}};
  for (const TargetRotor& r : m.rotors) {
    const double full = m.by_speed ? m.full * m.full : m.full;
    out["rotors"].push_back({{"thrust_at_full", r.kT * full},
                             {"moment_at_full", r.kQ * full},
                             {"r", {r.r.x(), r.r.y(), r.r.z()}},
                             {"a", {r.a.x(), r.a.y(), r.a.z()}}});
  }
  return out;
}

struct File {
  ident::Fields fields;
  TargetModel model;
  double mismatch;
};

File read_file(const std::string& target, const fs::path& path) {
  ident::Fields fields = fields_of(target, read(path), path.string());
  const TargetModel model = model_of(target, fields);
  const double mismatch = largest_mismatch(model, equations_of(target, fields));
  return {std::move(fields), model, mismatch};
}

// The equations of RotorPy speak of the centre of gravity only: where it is follows from the hubs, which are
// known.
void place_centre(TargetModel& model, const TargetModel& stated) {
  if (model.target != "rotorpy") return;
  model.c = Vector3d::Zero();
  for (std::size_t n = 0; n < kRotors; ++n)
    model.c += (stated.rotors[n].r - model.rotors[n].r) / static_cast<double>(kRotors);
}

json prediction(const Case& c, const File& before, const File& after) {
  const Horizon fitting{.every = 0.5}, scoring{.every = 0.25};
  std::vector<TrueFlight> shown, held_out;
  for (int log = 0; log < kShown; ++log)
    shown.emplace_back(c.flights[static_cast<std::size_t>(log)], c.effects.wind);
  held_out.emplace_back(c.flights.back(), c.effects.wind);
  const Errors unit_shown = changes(shown, fitting), unit = changes(held_out, scoring);
  const auto by_equations = [&](const File& file) {
    return rms(residuals(equations_of(c.target, file.fields), file.model.c, held_out, scoring, unit), unit);
  };
  const auto by_model = [&](const TargetModel& model) {
    return rms(residuals(model, held_out, scoring, unit), unit);
  };
  const TargetModel truth = reduced_truth(c.target, c.vehicle, c.effects, before.model);
  const auto on_shown = [&](const TargetModel& model) {
    return pooled(rms(residuals(model, shown, fitting, unit_shown), unit_shown), unit_shown);
  };
  const double truth_shown = on_shown(truth), after_shown = on_shown(after.model);
  const Fit fit = fit_best(truth, shown, fitting, unit_shown);
  const Errors of_fit = by_model(fit.model), of_truth = by_model(truth);
  const bool fit_is_best = pooled(of_fit, unit) <= pooled(of_truth, unit);
  const Errors best = fit_is_best ? of_fit : of_truth, errors_before = by_equations(before),
               errors_after = by_equations(after);
  return {{"unit", {unit.v, unit.attitude, unit.rate}},
          {"before", as_json(errors_before, unit)},
          {"after", as_json(errors_after, unit)},
          {"best", as_json(best, unit)},
          {"truth_reduced", as_json(of_truth, unit)},
          {"fitted", as_json(of_fit, unit)},
          {"best_is", fit_is_best ? "fitted" : "truth_reduced"},
          {"on_shown",
           {{"before", on_shown(before.model)},
            {"after", after_shown},
            {"truth_reduced", truth_shown},
            {"fitted", fit.pooled}}},
          {"fit_parameters", fit.parameters},
          {"fit_rounds", fit.rounds},
          {"models",
           {{"before", as_json(before.model)},
            {"after", as_json(after.model)},
            {"fitted", as_json(fit.model)},
            {"truth_reduced", as_json(truth)}}},
          {"after_over_best", pooled(errors_after, unit) / pooled(best, unit)},
          {"before_over_after", pooled(errors_before, unit) / pooled(errors_after, unit)}};
}

void write_path(const fs::path& path, const ClosedLoop& before, const ClosedLoop& after) {
  std::ofstream out(path);
  out << "t,aim_x,aim_y,aim_z,before_x,before_y,before_z,after_x,after_y,after_z\n";
  for (std::size_t k = 0; k < std::min(before.path.size(), after.path.size()); k += 5) {
    const Tracked &a = before.path[k], &b = after.path[k];
    out << a.t;
    for (const Vector3d& p : {a.aim, a.p, b.p}) out << ',' << p.x() << ',' << p.y() << ',' << p.z();
    out << '\n';
  }
}

json score(const fs::path& campaign, const std::string& answers, const fs::path& scores,
           const std::string& name) {
  const json truth = json::parse(read(campaign / "truth" / (name + ".json")));
  const Case c = draw_case(truth["campaign_seed"], truth["case"]);
  // Where nothing was written the user goes on with what there is.
  const fs::path stated = campaign / answers / name / "user_file",
                 fixed = campaign / answers / name / "fixed_file";
  File before = read_file(c.target, stated), after = read_file(c.target, fs::exists(fixed) ? fixed : stated);
  place_centre(after.model, before.model);
  const double mismatch = std::max(before.mismatch, after.mismatch), replayed = replay_error(c, 0.5);
  if (mismatch > 1e-9 || replayed > 1e-9)
    throw std::logic_error(name + ": the scorer's own equations are wrong");
  json out = {{"case", truth["case"]},
              {"target", c.target},
              {"replay_error", replayed},
              {"equations_mismatch", mismatch}};
  out["file_written"] = fs::exists(fixed);
  out["file_changed"] = fs::exists(fixed) && read(fixed) != read(stated);
  for (const Present& p : c.present) out["effects"].push_back(p.member.name);
  out["prediction"] = prediction(c, before, after);
  const References references(withheld::attitude_bandwidth(c.vehicle));
  const TargetModel true_model = reduced_truth(c.target, c.vehicle, c.effects, before.model);
  const ClosedLoop flown_before = fly_references(c, references, TunedController(before.model, references)),
                   flown_after = fly_references(c, references, TunedController(after.model, references)),
                   flown_truth = fly_references(c, references, TunedController(true_model, references));
  out["closed_loop"] = {{"before", as_json(flown_before)},
                        {"after", as_json(flown_after)},
                        {"truth_reduced", as_json(flown_truth)}};
  write_path(scores / (name + "_path.csv"), flown_before, flown_after);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const CommandLine options(argc, argv, {{"--campaign", ""}, {"--answers", "answers"}, {"--only", ""}});
    const fs::path campaign = options.required("--campaign");
    const std::string answers = options.text("--answers");
    const fs::path scores = campaign / ("scores_of_" + answers);
    fs::create_directories(scores);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(campaign / answers))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    for (const std::string& name : names) {
      const fs::path place = scores / (name + ".json");
      if (!options.text("--only").empty() && options.text("--only") != name) continue;
      if (!fs::exists(campaign / answers / name / "exit")) continue;
      if (options.text("--only").empty() && fs::exists(place)) continue;
      const json result = score(campaign, answers, scores, name);
      std::ofstream(place) << result.dump(1) << '\n';
      std::cerr << name << ' ' << result["target"] << " after/best "
                << result["prediction"]["after_over_best"] << " before/after "
                << result["prediction"]["before_over_after"] << " tracking "
                << result["closed_loop"]["before"]["rms"] << " -> " << result["closed_loop"]["after"]["rms"]
                << '\n';
    }
    return 0;
  } catch (const std::invalid_argument& error) {
    std::cerr << "mended_score: " << error.what()
              << "\nmended_score --campaign DIR [--answers FOLDER] [--only NNNN]\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "mended_score: " << error.what() << '\n';
    return 1;
  }
}
