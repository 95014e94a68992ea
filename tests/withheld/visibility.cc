// Signatures of what is withheld along the flown trajectories, and what nuisances leave of them.
#include "visibility.h"

#include <algorithm>
#include <cmath>

#include "detectability.h"

namespace withheld {

Effects effects_of(const Case& c, std::size_t without) {
  Effects e;
  e.gust_grip = c.effects.gust_grip;
  e.gust_arm = c.effects.gust_arm;
  for (std::size_t i = 0; i < c.withheld.size(); ++i) {
    c.withheld[i].member.accompany(e);
    if (i != without && without != kAll) c.withheld[i].member.apply(e, c.withheld[i].size);
  }
  return e;
}

namespace {

double relative(const KnownBefore& known, const std::string& name) {
  return known.at(name).std / known.at(name).value;
}

// Columns of signatures for one log, in a fixed order: base parameters, withheld members, catalogue. What may
// explain an effect away is linearised without it: a test against its absence knows no product with it.
std::vector<Channels> signatures(const Case& c, Prediction& predict, bool with_catalogue) {
  std::vector<Channels> columns;
  const Effects bare = effects_of(c, kAll);
  const Channels whole = predict(c.vehicle, c.effects), without = predict(c.vehicle, bare);
  for (const std::string& name : base_parameter_names()) {
    Vehicle v = c.vehicle;
    const double step = 0.1 * relative(c.known, name);
    base_parameter(v, name) *= 1 + step;
    columns.push_back((predict(v, bare) - without) / 0.1);
  }
  for (std::size_t i = 0; i < c.withheld.size(); ++i) {
    const Member& member = c.withheld[i].member;
    if (member.form == "outside") {
      columns.push_back(predict.recorded() - without);
    } else if (!member.wrong_parameter.empty()) {
      Vehicle v = c.vehicle;
      base_parameter(v, member.wrong_parameter) = c.known.at(member.wrong_parameter).value;
      columns.push_back(predict(v, c.effects) - whole);
    } else {
      columns.push_back(whole - predict(c.vehicle, effects_of(c, i)));
    }
  }
  if (!with_catalogue) return columns;
  for (const Direction& direction : catalogue_directions(c.vehicle)) {
    Effects before = bare, after;
    if (direction.nuisance) direction.nuisance(before);
    after = before;
    direction.apply(after, direction.step);
    const Channels from = direction.nuisance ? predict(c.vehicle, before) : without;
    columns.push_back(predict(c.vehicle, after) - from);
  }
  return columns;
}

Gram gram_of(const Case& c, bool with_catalogue) {
  const std::size_t base = base_parameter_names().size();
  const std::size_t count =
      base + c.withheld.size() + (with_catalogue ? catalogue_directions(c.vehicle).size() : 0);
  Gram gram(static_cast<Eigen::Index>(count));
  for (std::size_t log = 0; log < c.flights.size(); ++log) {
    Prediction predict(c.flights[log], c.instruments);
    gram.add(signatures(c, predict, with_catalogue), c.vehicle, c.effects, c.instruments,
             c.settings[log].gusts, predict.rate());
  }
  for (std::size_t i = 0; i < base; ++i) gram.add_prior(static_cast<Eigen::Index>(i));
  return gram;
}

std::vector<Eigen::Index> nuisances_of(const Case& c, std::size_t member, bool joint) {
  std::vector<Eigen::Index> result;
  const auto& names = base_parameter_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] != c.withheld[member].member.wrong_parameter) result.push_back(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; joint && i < c.withheld.size(); ++i) {
    if (i != member) result.push_back(static_cast<Eigen::Index>(names.size() + i));
  }
  return result;
}

double over_limit(const Case& c, const Gram& gram, std::size_t i, std::vector<Eigen::Index> nuisances) {
  const Member& member = c.withheld[i].member;
  const auto column = static_cast<Eigen::Index>(base_parameter_names().size() + i);
  if (!member.accompanying.empty() && gram.columns() > column + 2) {
    const auto directions = catalogue_directions(c.vehicle);
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (directions[k].effect == member.accompanying.front()) {
        nuisances.push_back(static_cast<Eigen::Index>(base_parameter_names().size() + c.withheld.size() + k));
      }
    }
  }
  double lambda = gram.left(column, nuisances);
  if (!member.wrong_parameter.empty()) {
    // The stated value is one more measurement: what counts is the discord of flight and statement.
    const Stated& stated = c.known.at(member.wrong_parameter);
    const double error = std::abs(stated.value - base_parameter(c.vehicle, member.wrong_parameter));
    lambda = 1 / (std::pow(stated.std / error, 2) + 1 / std::max(lambda, 1e-12));
  }
  return std::sqrt(lambda / required_noncentrality(member.freedom));
}

}  // namespace

void measure(Case* c, bool with_catalogue) {
  const Gram gram = gram_of(*c, with_catalogue);
  for (std::size_t i = 0; i < c->withheld.size(); ++i) {
    c->withheld[i].over_limit = over_limit(*c, gram, i, nuisances_of(*c, i, false));
    c->withheld[i].over_limit_joint = over_limit(*c, gram, i, nuisances_of(*c, i, true));
  }
  if (!with_catalogue || c->withheld.size() != 1) return;
  const auto directions = catalogue_directions(c->vehicle);
  for (const std::string& effect : catalogue_names()) {
    const Member& member = c->withheld.front().member;
    const auto& along = member.accompanying;
    if (effect == member.name || std::find(along.begin(), along.end(), effect) != along.end()) continue;
    std::vector<Eigen::Index> nuisances = nuisances_of(*c, 0, false);
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (directions[k].effect == effect) {
        nuisances.push_back(static_cast<Eigen::Index>(base_parameter_names().size() + 1 + k));
      }
    }
    c->look_alikes.push_back({effect, over_limit(*c, gram, 0, nuisances)});
  }
  std::stable_sort(c->look_alikes.begin(), c->look_alikes.end(),
                   [](const LookAlike& a, const LookAlike& b) { return a.left < b.left; });
}

}  // namespace withheld
