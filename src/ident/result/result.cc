// The JSON form of a result.
#include "ident/result/result.h"

#include <algorithm>

#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Parameter& p) {
  Json j;
  j["value"] = number_or_null(p.value);
  j["std"] = number_or_null(p.std);
  j["ci95"] = {number_or_null(p.ci95[0]), number_or_null(p.ci95[1])};
  j["unit"] = p.unit;
  j["identifiable"] = p.identifiable;
  j["source"] = p.source;
  if (p.naive_std) j["naive_std"] = number_or_null(*p.naive_std);
  if (p.prior_value)
    j["prior"] = {{"value", number_or_null(*p.prior_value)},
                  {"std", number_or_null(p.prior_std.value_or(kNaN))}};
  if (p.pull) j["pull"] = number_or_null(*p.pull);
  if (p.from_flight) j["from_flight"] = number_or_null(*p.from_flight);
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
        row.push_back(number_or_null(result.correlation.matrix(i, k)));
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
