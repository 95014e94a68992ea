// Draws a case until it can be flown and its effects can be sized in units of their detection limits.
#include "withheld_case.h"

#include <algorithm>
#include <cmath>

#include "visibility.h"

namespace withheld {

namespace {

constexpr double kLogLength = 45;                 // s
constexpr double kSmallest = 0.5, kLargest = 30;  // sizes near the detection limit, in units of it
constexpr double kTypical = 0.15;                 // lower end of typical sizes, in units of Member::apply

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
  if (!order.commands) c.instruments.rotor_speeds = true;
  Random of_estimator(seed, 1000);
  if (order.estimator) make_estimator(&c.instruments, of_estimator);
  if (order.filtered) make_filtered(&c.instruments, of_estimator);
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

CaseOrder campaign_order(std::uint64_t seed, int index, const std::string& only_kind, bool commands) {
  const std::string pattern =
      "nsspnosnssponssnpsnosonsp";  // of 25: an odd number, so halves by parity are alike
  const char letter = pattern[static_cast<std::size_t>(index % 25)];
  CaseOrder order;
  order.commands = commands;
  order.kind = !only_kind.empty() ? only_kind
               : letter == 'n'    ? "none"
               : letter == 's'    ? "single"
               : letter == 'p'    ? "pair"
                                  : "outside";
  Random random(seed * 7919ULL + static_cast<std::uint64_t>(index), 5);
  const auto pick = [&](const std::vector<std::string>& names) {
    for (;;) {
      const std::string& name =
          names[static_cast<std::size_t>(random.integer(0, static_cast<int>(names.size()) - 1))];
      if (commands || !acts_before_rotor_speed(name)) return name;
    }
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
