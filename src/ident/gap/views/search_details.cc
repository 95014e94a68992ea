// Details of a search as JSON.
#include "ident/gap/views/search_details.h"

#include "ident/result/json_number.h"

namespace ident {
namespace {

using Json = nlohmann::ordered_json;

Json as_json(const Rival& rival, const ResidualWrench& wrench) {
  Json left = Json::object();
  for (std::size_t c = 0; c < 6; ++c) left[wrench.names[c]] = rival.gain[c];
  for (const auto& [channel, gain] : rival.sensors) left[channel] = gain;
  return left;
}

Json scatter_of(const SearchResult& search) {
  Json scatter = Json::object();
  for (const Candidate& c : search.best.adopted) scatter[described(c)] = search.scatter_of(c);
  return scatter;
}

Json by_channel(const SearchResult& search) {
  Json out = Json::object();
  for (std::size_t i = 0; i < search.asked.size(); ++i) {
    Json parts = Json::object();
    for (const Asked& part : search.asked[i])
      parts[part.part] = {{"change", part.change}, {"std", part.std}, {"weight", part.weight}};
    out[described(search.best.adopted[i])] = parts;
  }
  return out;
}

Json as_json(std::span<const SpectralLine> lines) {
  Json out = Json::array();
  for (const SpectralLine& line : lines)
    out.push_back({{"channel", line.channel},
                   {"hz", line.hz},
                   {"height", line.height},
                   {"share", line.share},
                   {"rotor_hz", number_or_null(line.rotor_hz)}});
  return out;
}

Json as_json(const Vibration& vibration) {
  return {{"rates", vibration.rates},
          {"force", vibration.force},
          {"speeds", vibration.speeds},
          {"of_rotor", vibration.of_rotor},
          {"unbalanced", vibration.unbalanced()},
          {"stands_out", vibration.stands_out()}};
}

Json as_json(std::span<const Burst> bursts) {
  Json out = Json::array();
  for (const Burst& one : bursts)
    out.push_back({{"channel", one.channel},
                   {"log", one.log + 1},
                   {"count", one.count},
                   {"largest", one.largest},
                   {"t", one.t}});
  return out;
}

// Gusts as found with every cause free: standard deviation along three axes, m/s^2 and rad/s^2.
Json air_of(const NoiseModel& noise) {
  Json out = Json::array();
  for (const AirNoise& air : noise.air) {
    Json push = Json::array(), turn = Json::array();
    for (std::size_t k = 0; k < 3; ++k)
      push.push_back(air.v_dot[k].sigma), turn.push_back(air.w_dot[k].sigma);
    out.push_back({{"push", push}, {"turn", turn}, {"tau", air.v_dot[0].tau}});
  }
  return out;
}

Json steps_of(const SearchResult& search) {
  Json out = Json::array();
  for (const SearchStep& s : search.steps) out.push_back({{"adopted", s.name}, {"gain", s.gain}});
  return out;
}

}  // namespace

Json search_details(const SearchSeen& seen) {
  const SearchResult& search = seen.search;
  Json out{{"generic_rival", as_json(seen.rival, seen.wrench)},
           {"scatter", scatter_of(search)},
           {"by_channel", by_channel(search)},
           {"usual_scatter", search.usual_scatter()},
           {"lines", as_json(seen.lines)}};
  if (seen.vibration.found()) out["vibration"] = as_json(seen.vibration);
  out["bursts"] = as_json(seen.bursts);
  out["search"] = steps_of(search);
  if (const LevelThrust& thrust = search.thrust; std::isfinite(thrust.n))
    out["level_thrust"] = {{"n", thrust.n},       {"n_std", thrust.n_std},         {"varies", thrust.varies},
                           {"left", thrust.left}, {"stretches", thrust.stretches}, {"plain", thrust.plain()}};
  out["air_found"] = {{"comparison", air_of(search.form.noise)}, {"best", air_of(search.best.fit.noise)}};
  out["explained"] = search.explained();
  return out;
}

}  // namespace ident
