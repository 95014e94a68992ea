// withheld_rival: the stepwise regression on accelerations that a good diagnosis has to beat.
//
// Base parameters keep their priors; residuals are whitened; at each step all causes are screened to first
// order, the best are refitted, and the one with the best held-out likelihood is taken if it wins enough
// there and takes a material share of some smoothed residual. A generic regression on the inputs that beats
// the result says unknown.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "ident/io/vehicle/vehicle_read.h"
#include "rival_generic.h"

namespace {

using namespace rival;
using nlohmann::json;

constexpr double kWin = 12;         // nats of held-out likelihood that a cause has to win
constexpr double kMaterial = 0.12;  // share of a smoothed residual's power that it has to take
constexpr double kAlike = 4;        // nats within which causes count as alike
constexpr std::size_t kMost = 3;    // causes at once
constexpr std::size_t kRefitted = 4;

struct Tried {
  const Cause* cause;
  Fit fit;
  double won;
};

struct Diagnosis {
  std::vector<Tried> chosen;
  std::map<std::string, double> alike;  // causes as good as the last chosen
  std::map<std::string, double> probability;
  std::map<std::string, Fit> tried;
  Fit base, last;
};

Diagnosis diagnose(const Model& model, const std::vector<Log>& logs,
                   const std::vector<std::string>& excluded) {
  const Fitter fitter(model, logs);
  Diagnosis d;
  d.base = d.last = fitter.start();
  while (d.chosen.size() < kMost) {
    const std::vector<double> gains = fitter.screen(d.last);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < gains.size(); ++i) {
      const std::string& name = model.causes()[i].name;
      const bool out = std::find(excluded.begin(), excluded.end(), name) != excluded.end();
      const bool taken = std::any_of(d.chosen.begin(), d.chosen.end(),
                                     [&](const Tried& t) { return t.cause->name == name; });
      if (!out && !taken) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return gains[a] > gains[b]; });
    std::vector<Tried> tried;
    for (const std::size_t i : order) {
      if (tried.size() == kRefitted || gains[i] < kWin) break;
      const Cause& cause = model.causes()[i];
      Fit fit = fitter.with(d.last, cause, 2);
      const double parsimony = 1.0 * static_cast<double>(cause.parameters.size());
      tried.push_back({&cause, fit, fit.held_out - d.last.held_out - parsimony});
    }
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Tried& a, const Tried& b) { return a.won > b.won; });
    double weights = std::exp(kWin - (tried.empty() ? kWin : std::max(kWin, tried[0].won)));
    const double top = tried.empty() ? kWin : std::max(kWin, tried[0].won);
    for (const Tried& t : tried) weights += std::exp(t.won - top);
    for (const Tried& t : tried) {
      double& p = d.probability[t.cause->name];
      p = std::max(p, 0.98 * std::exp(t.won - top) / weights);
      d.tried.emplace(t.cause->name, t.fit);
    }
    for (const Tried& t : tried) std::cerr << "  " << t.cause->name << " wins " << t.won << " nats\n";
    if (tried.empty() || tried[0].won < kWin) break;
    if (material_share(model.residuals(d.last.theta), model.residuals(tried[0].fit.theta)) < kMaterial) break;
    std::cerr << "taken: " << tried[0].cause->name << '\n';
    d.alike.clear();
    for (const Tried& t : tried) {
      if (t.cause->name != tried[0].cause->name && t.won > tried[0].won - kAlike)
        d.alike[t.cause->name] = t.won;
    }
    d.last = tried[0].fit;
    d.chosen.push_back(tried[0]);
  }
  return d;
}

json parameters_of(const Model& model, const Cause& cause, const Fit& fit) {
  json all = json::object();
  for (const int index : cause.parameters) {
    std::string name = model.parameters()[static_cast<std::size_t>(index)].name;
    const auto row = std::find(fit.order.begin(), fit.order.end(), index) - fit.order.begin();
    double value = fit.theta[index], std = std::sqrt(std::max(0.0, fit.covariance(row, row)));
    if (cause.rotor > 0) name.pop_back();
    if (name == "motor_asymmetry.slow") name = "motor_asymmetry.ratio", value = 1 - value;
    if (name == "rotor_mismatch.weak") name = "rotor_mismatch.ratio", value = 1 - value;
    if (name == "ground_effect.radius2") {
      name = "ground_effect.radius";
      value = std::sqrt(std::max(value, 1e-12));
      std /= 2 * value;
    }
    const double load = fit.theta[model.index("payload.m")];
    if (cause.name == "payload" && name != "payload.m" && load > 0) {
      name = "payload." + name.substr(name.size() - 1);
      value /= load;
      std /= load;
    }
    all[name] = {{"value", value}, {"std", std}};
  }
  if (cause.rotor > 0) all[cause.name + ".rotor"] = {{"value", cause.rotor}, {"std", 0}};
  return all;
}

json verdict_of(const Diagnosis& d, const Model& model, const std::vector<Log>& logs) {
  const double generic_base = generic_gain(logs, model.residuals(d.base.theta));
  const double generic_left = generic_gain(logs, model.residuals(d.last.theta));
  const double won = d.last.held_out - d.base.held_out;
  std::cerr << "generic: " << generic_base << " nats, then " << generic_left << "; won " << won << '\n';
  json effects = json::array(), confused = json::array();
  std::string status = "identified";
  for (const Tried& t : d.chosen) effects.push_back(t.cause->name);
  if (d.chosen.empty())
    status = generic_base > 3 * kWin ? "unknown" : "none";
  else if (generic_left > 3 * kWin && generic_left > won)
    status = "unknown";
  else if (!d.alike.empty())
    status = "ambiguous";
  if (status == "unknown" || status == "none") effects.clear();
  if (status == "ambiguous") {
    for (const auto& [name, gain] : d.alike) confused.push_back(name);
  }
  return {{"status", status}, {"effects", effects}, {"confused_with", confused}};
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::vector<std::string> files, excluded;
    std::string vehicle_file;
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "gap" || word == "--json") continue;
      if (word == "--vehicle" && i + 1 < argc) {
        vehicle_file = argv[++i];
      } else if (word == "--exclude" && i + 1 < argc) {
        std::string name;
        for (std::istringstream list(argv[++i]); std::getline(list, name, ',');) excluded.push_back(name);
      } else {
        files.push_back(word);
      }
    }
    const VehicleFile vehicle = read_vehicle(vehicle_file);
    std::vector<Log> logs;
    for (const std::string& file : files) logs.push_back(read_log(file, vehicle));
    const Model model(vehicle, logs);
    const Diagnosis d = diagnose(model, logs, excluded);
    json out = {
        {"schema", "ident.gap/1"}, {"verdict", verdict_of(d, model, logs)}, {"candidates", json::array()}};
    std::map<std::string, const Cause*> causes;
    for (const Cause& cause : model.causes()) causes.emplace(cause.name, &cause);
    for (const Tried& t : d.chosen) causes[t.cause->name] = t.cause;
    for (const auto& [name, cause] : causes) {
      const auto p = d.probability.find(name);
      json entry = {{"effect", name}, {"probability", p == d.probability.end() ? 0.002 : p->second}};
      const bool chosen = std::any_of(d.chosen.begin(), d.chosen.end(),
                                      [&](const Tried& t) { return t.cause->name == name; });
      if (chosen) entry["parameters"] = parameters_of(model, *cause, d.last);
      out["candidates"].push_back(entry);
    }
    out["gap"] = {{"closed", closed_share(model.residuals(d.base.theta), model.residuals(d.last.theta))}};
    std::cout << out.dump(1) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "withheld_rival: " << error.what() << '\n';
    return 1;
  }
}
