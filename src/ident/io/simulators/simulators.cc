// The list of formats, and what is the same for all of them: import, export, uncertainty.
#include "ident/io/simulators/simulators.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ident/core/error.h"
#include "ident/core/nearest_word.h"
#include "ident/effects/all_parameters.h"
#include "ident/io/simulators/lost.h"
#include "ident/io/simulators/reduced.h"

namespace ident {

#define IDENT_SIMULATOR(name) SimulatorFormat name##_format();
#include "ident/io/simulators/simulators.def"
#undef IDENT_SIMULATOR

namespace {

const std::vector<SimulatorFormat>& formats() {
  static const std::vector<SimulatorFormat> list = {
#define IDENT_SIMULATOR(name) name##_format(),
#include "ident/io/simulators/simulators.def"
#undef IDENT_SIMULATOR
  };
  return list;
}

/// First numbers of all entries for a vehicle with one constant moved.
std::vector<double> moved(const SimulatorFormat& format, Vehicle vehicle, const Fields* own,
                          const std::string& name, double by) {
  vehicle.parameters[name].value += by;
  std::vector<double> numbers;
  for (const Value& value : format.values(held_by(format, vehicle), own))
    numbers.push_back(value.numbers.empty() ? 0.0 : value.numbers.front());
  return numbers;
}

/// Standard deviations to first order: sqrt(g' C g), g by central differences over a tenth of a deviation.
std::vector<double> deviations(const SimulatorFormat& format, const Vehicle& vehicle, const Fields* own,
                               std::size_t count) {
  std::vector<std::string> names;
  std::vector<std::vector<double>> slopes;  // times the deviation of the constant
  for (const auto& [name, known] : vehicle.parameters) {
    if (!known.std || !(*known.std > 0)) continue;
    const double h = 0.1 * std::min(*known.std, known.value != 0 ? std::abs(known.value) : *known.std);
    const std::vector<double> up = moved(format, vehicle, own, name, h),
                              down = moved(format, vehicle, own, name, -h);
    if (up.size() != count || down.size() != count) continue;
    std::vector<double> slope(count);
    for (std::size_t i = 0; i < count; ++i) slope[i] = (up[i] - down[i]) / (2 * h) * *known.std;
    names.push_back(name), slopes.push_back(std::move(slope));
  }
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    double variance = 0;
    for (std::size_t a = 0; a < names.size(); ++a)
      for (std::size_t b = 0; b < names.size(); ++b)
        variance += slopes[a][i] * slopes[b][i] * vehicle.correlation.of(names[a], names[b]);
    out[i] = std::sqrt(std::max(variance, 0.0));
  }
  return out;
}

/// What a vehicle needs to fly in any simulator; a value that cannot be is the file's error.
void expect_possible(const Vehicle& vehicle, const Fields& fields) {
  for (const auto& [name, known] : vehicle.parameters) {
    const ParameterInfo* info = find_parameter(name);
    const bool moment = name == "Jxx" || name == "Jyy" || name == "Jzz";
    if (!std::isfinite(known.value))
      throw InputError(fields.file(), 0, name, "is not finite: a value in the file is zero or too large");
    if (info && (moment || info->kind == ParameterKind::positive) && !(known.value > 0))
      throw InputError(fields.file(), 0, name,
                       fmt::format("would be {:.4g}, and has to be positive", known.value));
  }
}

}  // namespace

std::span<const SimulatorFormat> simulator_formats() { return formats(); }

const SimulatorFormat& find_simulator(std::string_view target) {
  std::vector<std::string> names;
  for (const SimulatorFormat& format : formats()) {
    if (format.target == target) return format;
    names.emplace_back(format.target);
  }
  throw UsageError(fmt::format("'{}' is no target of an export: {}{}", target, fmt::join(names, ", "),
                               did_you_mean(target, names)));
}

const SimulatorFormat* recognised_simulator(std::string_view text) {
  for (const SimulatorFormat& format : formats())
    if (format.recognises && format.recognises(text)) return &format;
  return nullptr;
}

Vehicle vehicle_of_simulator(const SimulatorFormat& format, const std::string& text,
                             const std::string& file) {
  const Fields fields = format.read(text, file);
  Vehicle vehicle = format.vehicle(fields);
  vehicle.file = file;
  for (auto& [name, known] : vehicle.parameters) known.value = as_stated(known.value);
  for (Rotor& rotor : vehicle.rotors)
    rotor.r_B = rotor.r_B.unaryExpr(&as_stated).eval(), rotor.a_B = rotor.a_B.unaryExpr(&as_stated).eval();
  expect_possible(vehicle, fields);
  return vehicle;
}

Vehicle held_by(const SimulatorFormat& format, const Vehicle& vehicle) {
  Vehicle held = reduced(vehicle, format.holds, format.target);
  if (format.stand_in) format.stand_in(vehicle, held);
  return held;
}

Values values_for(const SimulatorFormat& format, const Vehicle& vehicle, const Fields* own) {
  Values values(format.values(held_by(format, vehicle), own));
  values.deviations = deviations(format, vehicle, own, values.all().size());
  values.source = vehicle.name.empty() ? vehicle.file : vehicle.name;
  return values;
}

SimulatorExport export_to_simulator(const SimulatorFormat& format, const Vehicle& vehicle) {
  SimulatorExport out{.reduced = held_by(format, vehicle),
                      .lost = lost(vehicle, format.holds, format.target)};
  if (format.remarks)
    for (std::string& remark : format.remarks(vehicle, out.reduced)) out.lost.push_back(std::move(remark));
  out.text = format.page(out.reduced, values_for(format, vehicle));
  return out;
}

}  // namespace ident
