// The JSON form of a result.
#include "ident/core/result.h"

#include <algorithm>

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json to_json(const Parameter& p) {
  Json j;
  j["value"] = number(p.value);
  j["std"] = number(p.std);
  j["ci95"] = {number(p.ci95[0]), number(p.ci95[1])};
  j["unit"] = p.unit;
  j["identifiable"] = p.identifiable;
  j["source"] = p.source;
  if (p.naive_std) j["naive_std"] = number(*p.naive_std);
  if (p.prior_value)
    j["prior"] = {{"value", number(*p.prior_value)}, {"std", number(p.prior_std.value_or(kNaN))}};
  if (p.pull) j["pull"] = number(*p.pull);
  if (p.from_flight) j["from_flight"] = number(*p.from_flight);
  if (!p.note.empty()) j["note"] = p.note;
  return j;
}

}  // namespace

const Parameter* Result::find(const std::string& name) const {
  const auto at = std::ranges::find(parameters, name, &Parameter::name);
  return at == parameters.end() ? nullptr : &*at;
}

bool Result::has_warning(const std::string& code) const {
  return std::ranges::any_of(warnings, [&](const Warning& w) { return w.code == code; });
}

Json to_json(const Result& result) {
  Json j;
  j["schema"] = result.schema;
  j["command"] = result.command;
  j["inputs"] = result.inputs;
  Json parameters = Json::object();
  for (const Parameter& p : result.parameters) parameters[p.name] = to_json(p);
  j["parameters"] = parameters;
  j["fit"] = result.fit;
  Json warnings = Json::array();
  for (const Warning& w : result.warnings) warnings.push_back({{"code", w.code}, {"message", w.message}});
  j["warnings"] = warnings;
  if (!result.correlation.empty()) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < result.correlation.matrix.rows(); ++i) {
      Json row = Json::array();
      for (Eigen::Index k = 0; k < result.correlation.matrix.cols(); ++k)
        row.push_back(number(result.correlation.matrix(i, k)));
      rows.push_back(row);
    }
    j["correlation"] = {{"names", result.correlation.names}, {"matrix", rows}};
  }
  if (!result.verdict.empty()) j["summary"] = result.verdict;
  if (result.seed) j["seed"] = *result.seed;
  j.update(result.extra);
  return j;
}

}  // namespace ident
