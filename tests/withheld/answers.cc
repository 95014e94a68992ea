// Reads truth and answers; an answer that is missing or not in the agreed form counts as not given.
#include "answers.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace withheld {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json read_json(const fs::path& path) {
  std::ifstream in(path);
  return json::parse(in, nullptr, false);
}

double number_in(const fs::path& path) {
  std::ifstream in(path);
  double value = 0;
  in >> value;
  return value;
}

std::optional<double> number(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key) || !object[key].is_number()) return std::nullopt;
  return object[key].get<double>();
}

void collect(const json& from, Names& names) {  // names, or sets of names
  if (from.is_string()) names.insert(from.get<std::string>());
  if (from.is_array()) {
    for (const json& item : from) collect(item, names);
  }
}

TrueEffect true_effect(const json& from) {
  TrueEffect effect;
  effect.name = from.at("name");
  effect.form = from.at("form");
  effect.over_limit = from.at("size_over_limit");
  effect.over_limit_joint = from.at("size_over_limit_joint");
  effect.parameters = from.at("parameters").get<std::map<std::string, double>>();
  return effect;
}

Truth read_truth(const fs::path& path) {
  const json from = read_json(path);
  if (from.is_discarded()) throw std::runtime_error("not readable: " + path.string());
  Truth truth;
  truth.index = from.at("case");
  truth.kind = from.at("kind");
  truth.rotor_speeds = from.at("vehicle").at("rotor_speeds");
  for (const json& effect : from.at("effects")) truth.effects.push_back(true_effect(effect));
  if (!from.at("outside").is_null()) truth.outside = true_effect(from.at("outside"));
  collect(from.at("accompanying"), truth.accompanying);
  for (const json& other : from.at("look_alikes")) {
    truth.left_by_look_alike = std::min(truth.left_by_look_alike, other.at("left_over_limit").get<double>());
  }
  return truth;
}

Candidate candidate(const json& from) {
  Candidate result;
  result.probability = number(from, "probability");
  result.closed = number(from, "closed");
  if (from.contains("parameters")) {
    for (const auto& [name, value] : from["parameters"].items()) {
      if (number(value, "value") && number(value, "std")) {
        result.parameters[name] = {*number(value, "value"), *number(value, "std")};
      }
    }
  }
  if (from.contains("detection_limit") && from["detection_limit"].is_object()) {
    for (const auto& [name, value] : from["detection_limit"].items()) {
      if (value.is_number()) result.detection_limit[name] = value.get<double>();
    }
  }
  return result;
}

Answer read_answer(const fs::path& stem) {
  Answer answer;
  answer.seconds = number_in(stem.string() + ".seconds");
  const json from = read_json(stem.string() + ".json");
  if (!from.is_object() || number_in(stem.string() + ".exit") != 0 || !from.contains("verdict"))
    return answer;
  const json& verdict = from["verdict"];
  answer.status = verdict.value("status", "");
  if (verdict.contains("effects")) collect(verdict["effects"], answer.effects);
  if (verdict.contains("confused_with")) collect(verdict["confused_with"], answer.confused_with);
  answer.given = Names{"none", "identified", "partly", "ambiguous", "unknown"}.count(answer.status) > 0;
  if (from.contains("candidates")) {
    for (const json& item : from["candidates"]) answer.candidates[item.value("effect", "")] = candidate(item);
  }
  if (from.contains("gap")) answer.closed = number(from["gap"], "closed");
  return answer;
}

}  // namespace

Names Truth::names() const {
  Names result;
  for (const TrueEffect& effect : effects) result.insert(effect.name);
  return result;
}

std::vector<Scored> read_campaign(const std::string& folder, const std::string& answers,
                                  const std::string& half) {
  if (half != "odd" && half != "even" && half != "all")
    throw std::invalid_argument("--half is odd, even or all");
  std::vector<Scored> result;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "truth")) {
    if (entry.path().extension() != ".json") continue;
    Scored scored;
    scored.truth = read_truth(entry.path());
    if (half != "all" && (scored.truth.index % 2 == 1) != (half == "odd")) continue;
    const fs::path stem = fs::path(folder) / answers / entry.path().stem();
    scored.answer = read_answer(stem);
    if (fs::exists(stem.string() + ".excluded.json"))
      scored.excluded = read_answer(stem.string() + ".excluded");
    result.push_back(std::move(scored));
  }
  std::sort(result.begin(), result.end(),
            [](const Scored& a, const Scored& b) { return a.truth.index < b.truth.index; });
  return result;
}

}  // namespace withheld
