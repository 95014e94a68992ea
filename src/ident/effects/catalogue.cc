// The catalogue as data.
#include "ident/effects/catalogue.h"

#include <algorithm>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"

namespace ident {
namespace {

template <class Effect>
constexpr bool drives() {
  return requires(const double* p, DriveSeam<double>& drive) { Effect::apply(p, drive); }
  || requires(const double* p, TimeSeam<double>& time) { Effect::apply(p, time); };
}

const std::vector<EffectEntry>& entries() {
  static const std::vector<EffectEntry> list = {
#define IDENT_EFFECT(file, Type)                                                                          \
  {EffectId::file, Type::info, Type::parameters, kEffectOffset[static_cast<std::size_t>(EffectId::file)], \
   drives<Type>()},
#include "ident/effects/effects.def"
#undef IDENT_EFFECT
  };
  return list;
}

}  // namespace

std::span<const EffectEntry> catalogue() { return entries(); }

const EffectEntry& entry(EffectId id) { return entries()[static_cast<std::size_t>(id)]; }

const EffectEntry* find_effect(std::string_view name) {
  const auto at = std::ranges::find_if(entries(), [&](const EffectEntry& e) { return e.info.name == name; });
  return at == entries().end() ? nullptr : &*at;
}

const EffectParameter* find_effect_parameter(std::string_view full_name) {
  const std::size_t dot = full_name.find('.');
  const EffectEntry* effect = find_effect(full_name.substr(0, dot));
  if (!effect || dot == std::string_view::npos) return nullptr;
  const auto at = std::ranges::find(effect->parameters, full_name.substr(dot + 1), &EffectParameter::name);
  return at == effect->parameters.end() ? nullptr : &*at;
}

std::vector<double> null_parameters() {
  std::vector<double> p(static_cast<std::size_t>(kParameterCount));
  for (const ParameterInfo& info : all_parameters())
    p[static_cast<std::size_t>(info.index)] = info.null_value;
  return p;
}

std::vector<double> parameter_vector(const Vehicle& vehicle) {
  std::vector<double> p = null_parameters();
  for (const ParameterInfo& info : all_parameters()) {
    if (vehicle.has(info.name)) p[static_cast<std::size_t>(info.index)] = vehicle.value(info.name);
  }
  for (const int needed : {param::m, param::Jxx, param::Jyy, param::Jzz, param::kT}) {
    if (!(p[static_cast<std::size_t>(needed)] > 0)) {
      const std::string& name = all_parameters()[static_cast<std::size_t>(needed)].name;
      throw UsageError((vehicle.file.empty() ? std::string("vehicle") : vehicle.file) + ": " +
                       (name == "m" ? "mass" : name) + ": a positive value is needed to model flight");
    }
  }
  return p;
}

EffectMask active_effects(std::span<const double> p) {
  EffectMask mask = 0;
  for (const EffectEntry& e : entries()) {
    for (std::size_t i = 0; i < e.parameters.size(); ++i) {
      if (p[static_cast<std::size_t>(e.offset) + i] != e.parameters[i].null_value) mask |= mask_of(e.id);
    }
  }
  return mask;
}

}  // namespace ident
