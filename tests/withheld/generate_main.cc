// withheld_generate: draws a campaign of flights and keeps the truth about them apart.
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

#include "withheld_case.h"

namespace {

struct Options {
  std::uint64_t seed = 1;
  int cases = 10, first = 1;
  std::string out, kind, only;
  bool commands = true;
  std::string sensors = "white";
  double size = 0;
};

constexpr const char* kUsage =
    "withheld_generate --seed S --cases N --out DIR [--first I] [--kind none|single|pair|outside]\n"
    "                  [--only EFFECT[,EFFECT] [--size X]]     X in units of the detection limit\n"
    "                  [--input commands|speeds]               speeds: logs without commands\n"
    "                  [--sensors white|estimator|filtered]    estimator: attitude drifts, velocity is off;\n"
    "                                                          filtered: rates and specific force are\n";

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    if (i + 1 >= argc) throw std::invalid_argument(name + " needs a value");
    const std::string value = argv[i + 1];
    if (name == "--seed")
      o.seed = std::stoull(value);
    else if (name == "--cases")
      o.cases = std::stoi(value);
    else if (name == "--first")
      o.first = std::stoi(value);
    else if (name == "--out")
      o.out = value;
    else if (name == "--kind")
      o.kind = value;
    else if (name == "--input" && value != "commands" && value != "speeds")
      throw std::invalid_argument("--input is commands or speeds");
    else if (name == "--input")
      o.commands = value == "commands";
    else if (name == "--sensors" && value != "white" && value != "estimator" && value != "filtered")
      throw std::invalid_argument("--sensors is white, estimator or filtered");
    else if (name == "--sensors")
      o.sensors = value;
    else if (name == "--only")
      o.only = value;
    else if (name == "--size")
      o.size = std::stod(value);
    else
      throw std::invalid_argument("no option is called " + name);
  }
  if (o.out.empty()) throw std::invalid_argument("--out DIR is needed");
  return o;
}

withheld::CaseOrder order_of(const Options& o, int index) {
  withheld::CaseOrder order;
  if (o.only.empty()) {
    order = withheld::campaign_order(o.seed, index, o.kind, o.commands);
  } else {
    for (std::size_t from = 0; from != std::string::npos;) {
      const std::size_t comma = o.only.find(',', from);
      order.members.push_back(o.only.substr(from, comma - from));
      from = comma == std::string::npos ? comma : comma + 1;
    }
    const auto& outside = withheld::outside_names();
    const bool is_outside = std::find(outside.begin(), outside.end(), order.members[0]) != outside.end();
    order.kind = is_outside ? "outside" : order.members.size() > 1 ? "pair" : "single";
  }
  order.size = o.size, order.commands = o.commands;
  order.estimator = o.sensors == "estimator", order.filtered = o.sensors == "filtered";
  for (const std::string& name : order.members)
    if (!o.commands && withheld::acts_before_rotor_speed(name))
      throw std::invalid_argument(name + " does not show in logs without commands");
  return order;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options o = parse(argc, argv);
    for (int index = o.first; index < o.first + o.cases; ++index) {
      const withheld::Case drawn = withheld::draw_case(o.seed, index, order_of(o, index));
      withheld::write_case(drawn, index, o.out);
      std::cerr << index << ' ' << drawn.order.kind;
      for (const auto& w : drawn.withheld) std::cerr << ' ' << w.member.name << ' ' << w.over_limit;
      std::cerr << '\n';
    }
    return 0;
  } catch (const std::invalid_argument& error) {
    std::cerr << "withheld_generate: " << error.what() << '\n' << kUsage;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "withheld_generate: " << error.what() << '\n';
    return 1;
  }
}
