// Draws a case until it can be flown and its effects can be sized in units of their detection limits.
#include "withheld_case.h"

#include <algorithm>
#include <cmath>

#include "detectability.h"

namespace withheld {

namespace {

constexpr double kLogLength = 45;                 // s
constexpr double kSmallest = 0.5, kLargest = 30;  // sizes near the detection limit, in units of it
constexpr double kTypical = 0.15;                 // lower end of typical sizes, in units of Member::apply

double relative(const KnownBefore& known, const std::string& name) {
  return known.at(name).std / known.at(name).value;
}

constexpr std::size_t kNone = 98, kAll = 99;

Effects effects_of(const Case& c, std::size_t without = kNone) {
  Effects e;
  e.gust_grip = c.effects.gust_grip;
  e.gust_arm = c.effects.gust_arm;
  for (std::size_t i = 0; i < c.withheld.size(); ++i) {
    c.withheld[i].member.accompany(e);
    if (i != without && without != kAll) c.withheld[i].member.apply(e, c.withheld[i].size);
  }
  return e;
}

void fly_both(Case* c) {
  c->flights.clear();
  double reference = 0;
  for (int log = 0; log < 2; ++log) {
    c->flights.push_back(fly(c->vehicle, c->effects, c->instruments,
                             c->settings[static_cast<std::size_t>(log)], c->seed, log, reference));
    reference = c->flights.front().reference_voltage;
    if (!c->flights.back().flown) return;
  }
}

bool flown(const Case& c) { return c.flights.size() == 2 && c.flights[0].flown && c.flights[1].flown; }

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

FlightSettings draw_settings(const Case& c, int log, Random& random) {
  FlightSettings s;
  s.plan.duration = kLogLength * random.uniform(0.95, 1.05);
  s.plan.liveliness = random.uniform(0.6, 1.4);
  s.charge = log == 0 ? random.uniform(0.75, 0.98) : random.uniform(0.3, 0.65);
  s.gusts.sigma = random.chance(0.8) ? random.log_uniform(0.03, 0.4) : 0.0;
  s.gusts.time = random.uniform(3, 12) / random.uniform(2, 5);
  for (const Withheld& w : c.withheld) {
    s.plan.near_ground |= w.member.plan.near_ground;
    s.plan.fast_descent |= w.member.plan.fast_descent;
    s.plan.multisine |= w.member.plan.multisine;
    s.delay_margin += w.member.delay_margin;
  }
  return s;
}

// Everything but the sizes of the members.
Case draw_scene(std::uint64_t seed, const CaseOrder& order) {
  Case c;
  c.order = order;
  c.seed = seed;
  Random random(seed);
  c.vehicle = draw_vehicle(random);
  for (const std::string& name : order.members) c.withheld.push_back({draw_member(name, c.vehicle, random)});
  c.instruments = draw_instruments(c.vehicle, random);
  for (int log = 0; log < 2; ++log) c.settings[static_cast<std::size_t>(log)] = draw_settings(c, log, random);
  c.known = draw_known_before(c.vehicle, random);
  c.effects.gust_grip = random.uniform(0.15, 0.4);
  c.effects.gust_arm = 0.03 * c.vehicle.arm;
  for (Withheld& w : c.withheld) {
    if (w.member.wrong_parameter.empty()) continue;
    c.known.at(w.member.wrong_parameter).std *= random.log_uniform(0.15, 1);  // said with confidence
  }
  return c;
}

void set_sizes(Case* c) {
  c->effects = effects_of(*c);
  for (const Withheld& w : c->withheld) {
    if (!w.member.wrong_parameter.empty()) make_wrong(c->vehicle, w.member, w.size, &c->known);
  }
}

// Half of the cases lie near the detection limit, the others are as large as such effects typically are.
bool choose_sizes(Case* c, Random& random) {
  for (Withheld& w : c->withheld) w.size = 0.3;
  set_sizes(c);
  fly_both(c);
  for (int retry = 0; retry < 3 && !flown(*c); ++retry) {
    for (Withheld& w : c->withheld) w.size *= 0.4;
    set_sizes(c);
    fly_both(c);
  }
  if (!flown(*c)) return false;
  measure(c, false);
  bool visible = true;
  const bool near_limit = random.chance(0.5);
  for (Withheld& w : c->withheld) {
    const double at_most = w.over_limit / w.size;  // at size 1
    visible = visible && at_most > 1.2 * kSmallest;
    const double top = std::clamp(at_most, 1.05 * kSmallest, kLargest);
    double wanted = random.log_uniform(kSmallest, top);
    if (!near_limit) wanted = std::max(wanted, at_most * random.log_uniform(kTypical, 1));
    if (c->order.size > 0) wanted = c->order.size;
    w.size = std::min(1.0, wanted / std::max(at_most, 1e-9));
  }
  return visible;
}

// Effects that bend the flight change their own visibility: a wanted size is met by iteration.
void correct_sizes(Case* c) {
  const Case before = *c;
  measure(c, false);
  for (Withheld& w : c->withheld)
    w.size = std::min(1.0, w.size * c->order.size / std::max(w.over_limit, 1e-9));
  set_sizes(c);
  fly_both(c);
  if (!flown(*c)) *c = before;
}

}  // namespace

Case draw_case(std::uint64_t seed, int index, const CaseOrder& order) {
  Case c;
  constexpr int kAttempts = 8;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::uint64_t scene =
        seed * 1000003ULL + static_cast<std::uint64_t>(index) * 64ULL + static_cast<std::uint64_t>(attempt);
    c = draw_scene(scene, order);
    c.attempts = attempt + 1;
    Random random(scene, 7);
    const bool visible = c.withheld.empty() || choose_sizes(&c, random);
    if (!visible && attempt + 2 < kAttempts) continue;
    for (int retry = 0; retry < 4; ++retry) {
      set_sizes(&c);
      fly_both(&c);
      if (flown(c)) break;
      for (Withheld& w : c.withheld) w.size *= 0.6;
      if (c.withheld.empty()) break;
    }
    if (flown(c)) break;
  }
  if (!flown(c)) throw std::runtime_error("no flight of case " + std::to_string(index) + " could be flown");
  for (int round = 0; round < 3 && order.size > 0; ++round) correct_sizes(&c);
  if (!c.withheld.empty()) measure(&c, true);
  return c;
}

namespace {

// Wind acts through rotor drag and flapping brings a force of its form: as a pair with it they have no own
// truth.
bool share_a_force(const std::vector<std::string>& pair) {
  const auto has = [&](const char* name) { return std::find(pair.begin(), pair.end(), name) != pair.end(); };
  return has("rotor_drag") && (has("wind") || has("blade_flapping"));
}

}  // namespace

CaseOrder campaign_order(std::uint64_t seed, int index, const std::string& only_kind) {
  const std::string pattern =
      "nsspnosnssponssnpsnosonsp";  // of 25: an odd number, so halves by parity are alike
  const char letter = pattern[static_cast<std::size_t>(index % 25)];
  CaseOrder order;
  order.kind = !only_kind.empty() ? only_kind
               : letter == 'n'    ? "none"
               : letter == 's'    ? "single"
               : letter == 'p'    ? "pair"
                                  : "outside";
  Random random(seed * 7919ULL + static_cast<std::uint64_t>(index), 5);
  const auto pick = [&](const std::vector<std::string>& names) {
    return names[static_cast<std::size_t>(random.integer(0, static_cast<int>(names.size()) - 1))];
  };
  const auto any = [&] {
    return random.chance(0.17) ? pick(wrong_parameter_names()) : pick(catalogue_names());
  };
  if (order.kind == "single") order.members = {any()};
  if (order.kind == "outside") order.members = {pick(outside_names())};
  if (order.kind == "pair") {
    order.members = {any(), any()};
    while (order.members[1] == order.members[0] || share_a_force(order.members)) order.members[1] = any();
  }
  return order;
}

}  // namespace withheld
