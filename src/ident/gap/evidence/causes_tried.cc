// Evidence, detection limit and parameters of each cause.
#include "ident/gap/evidence/causes_tried.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"
#include "ident/gap/search/further.h"
#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSeen = 3.63 + 1.28;  // 1 % family-wise over the catalogue, 90 % power

// Value, standard deviation and unit of each constant of an adopted effect, under the file format's name.
Json adopted_parameters(const FittedModel& model, const Candidate& cause) {
  Json j = Json::object();
  const Theta& theta = *model.theta;
  for (int i = 0; i < theta.constants_count(); ++i) {
    const FreeConstant& constant = theta.constants()[static_cast<std::size_t>(i)];
    if (!is_constant_of(cause, constant, i)) continue;
    std::string name = constant.name;
    double value = theta.physical(model.fit.u, i);
    double std = theta.deviation(model.fit.u, i, model.fit.covariance);
    std::string unit = parameter_unit(name);
    name = name.substr(0, name.find('@'));
    if (name == "ground_effect.radius_sq") {
      name = "ground_effect.radius", unit = "m";
      value = std::sqrt(std::max(value, 1e-12)), std = std / (2 * value);
    }
    j[name] = {{"value", number_or_null(value)}, {"std", number_or_null(std)}, {"unit", unit}};
  }
  if (cause.rotor >= 0) j[cause.name + ".rotor"] = {{"value", cause.rotor + 1}, {"std", 0}, {"unit", "-"}};
  return j;
}

struct Entry {
  std::string name;
  double gain = 0;  ///< the most of its rotors
  Json limits = Json::object();
};
using Entries = std::vector<Entry>;

// What a cause gains, and the size that would have been seen, from the form that it is tried in.
void enter(Entries& entries, const QuadraticForm& form, const ExtendedProblem& problem, std::size_t place,
           double gain) {
  const Candidate& cause = problem.candidates[place];
  auto at = std::ranges::find(entries, cause.name, &Entry::name);
  if (at == entries.end()) at = entries.insert(at, {cause.name});
  at->gain = std::max(at->gain, gain);
  const std::size_t many = cause.parameter >= 0 ? 1 : cause.directions.size();
  for (std::size_t d = 0; d < many; ++d) {
    const int i = cause.parameter >= 0 ? cause.parameter : cause.directions[d];
    std::string name = problem.constants[static_cast<std::size_t>(i)].name;
    if (name.substr(0, name.find('.')) != cause.name && cause.parameter < 0) continue;
    name = name.substr(0, name.find('@'));
    double limit = kSeen * deviation_of(form, problem, static_cast<int>(place), static_cast<int>(d));
    if (name == "ground_effect.radius_sq") name = "ground_effect.radius", limit = std::sqrt(limit);
    // The largest of its rotors; one that nothing would show, null, is larger than all.
    const auto known = at->limits.find(name);
    if (known == at->limits.end() || (known->is_number() && !(limit <= known->get<double>())))
      at->limits[name] = number_or_null(limit);
  }
}

// Beside the model as it is; what acts only through another cause, as wind does through drag, beside those
// found.
Entries entries_of(const SearchResult& search) {
  Entries entries;
  const ExtendedProblem& base = search.base_problem;
  for (std::size_t c = 0; c < base.candidates.size(); ++c) {
    const SetGain set = gain_of(search.base_form, base, {static_cast<int>(c)});
    enter(entries, search.base_form, base, c, set.physical() ? set.gain : 0.0);
  }
  const std::size_t alone = entries.size();
  const std::vector<int> have = places_of(search.best.adopted, search.problem);
  for (std::size_t c = 0; c < search.problem.candidates.size(); ++c) {
    const auto known = std::span(entries).first(alone);
    if (std::ranges::find(known, search.problem.candidates[c].name, &Entry::name) != known.end()) continue;
    std::vector<int> others = have, with = have;
    std::erase(others, static_cast<int>(c));
    if (others.size() == have.size()) with.push_back(static_cast<int>(c));
    const SetGain set = gain_of(search.form, search.problem, with),
                  rest = gain_of(search.form, search.problem, others);
    enter(entries, search.form, search.problem, c,
          set.physical() ? std::max(set.gain - rest.gain, 0.0) : 0.0);
  }
  return entries;
}

}  // namespace

Json causes_tried(const SearchResult& search,
                  const std::function<GapClosed(const Candidate&)>& closed_alone) {
  Json out = Json::array();
  for (const Entry& entry : entries_of(search)) {
    const auto found = std::ranges::find(search.best.adopted, entry.name, &Candidate::name);
    const bool adopted = found != search.best.adopted.end();
    const GapClosed closed = adopted ? closed_alone(*found) : GapClosed{};
    out.push_back({{"effect", entry.name},
                   {"probability", search.probability_of(entry.name)},
                   {"detection_limit", entry.limits},
                   {"closed", number_or_null(closed.closed)},
                   {"closed_ci95", {number_or_null(closed.ci95[0]), number_or_null(closed.ci95[1])}},
                   {"evidence", entry.gain},
                   {"parameters", adopted ? adopted_parameters(search.best, *found) : Json::object()}});
  }
  std::stable_sort(out.begin(), out.end(), [](const Json& a, const Json& b) {
    const auto rank = [](const Json& c) {  // probabilities that look the same do not order
      return std::pair(std::round(1e3 * c["probability"].get<double>()), c["evidence"].get<double>());
    };
    return rank(a) > rank(b);
  });
  return out;
}

std::vector<std::string> below_their_limit(const SearchResult& search, double times) {
  std::vector<std::string> out;
  const ExtendedProblem& base = search.base_problem;
  const Theta& theta = *search.best.theta;
  for (const Candidate& cause : search.best.adopted) {
    const auto tried = std::ranges::find_if(base.candidates, [&](const Candidate& c) {
      return c.name == cause.name && c.rotor == cause.rotor && c.parameter < 0;
    });
    if (tried == base.candidates.end()) continue;
    double size = 0;
    std::size_t known = 0;  // of its directions: a payload's are others to first order
    for (std::size_t d = 0; d < tried->directions.size(); ++d) {
      const std::string& name = base.constants[static_cast<std::size_t>(tried->directions[d])].name;
      const auto place = static_cast<int>(tried - base.candidates.begin());
      const double limit = kSeen * deviation_of(search.base_form, base, place, static_cast<int>(d));
      for (int i = 0; i < theta.constants_count(); ++i)
        if (const FreeConstant& constant = theta.constants()[static_cast<std::size_t>(i)];
            constant.name == name)
          known += 1, size += std::pow(
                          (theta.physical(search.best.fit.u, i) - value_without(cause, constant)) / limit, 2);
    }
    if (known == tried->directions.size() && size > 0 && size < times * times) out.push_back(cause.name);
  }
  return out;
}

Json causes_not_tried(const SearchResult& search, const Vehicle& vehicle,
                      const std::vector<std::string>& exclude) {
  Json out = Json::array();
  const auto tried = [&](const ExtendedProblem& problem, const std::string& name) {
    return std::ranges::find(problem.candidates, name, &Candidate::name) != problem.candidates.end();
  };
  for (const EffectEntry& effect : catalogue()) {
    const std::string name(effect.info.name);
    if (tried(search.base_problem, name) || tried(search.problem, name)) continue;
    const char* why = "these logs or this model cannot show it";
    if (std::ranges::find(exclude, name) != exclude.end())
      why = "left out as asked";
    else if (states_effect(vehicle, name) ||
             (effect.id == EffectId::gyroscopic && vehicle.parameters.contains("Jp")))
      why = "stated in the vehicle file";
    else if (effect.id == EffectId::wind)
      why = "it acts through drag, and none was stated or found";
    out.push_back({{"effect", name}, {"why", why}});
  }
  return out;
}

}  // namespace ident
