// All effects together: their names and parameters, and `EffectSet`, which enters the active ones into the
// model.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ident/effects/all_effects.h"  // generated from effects.def: includes each effect's file
#include "ident/model/parameters.h"
#include "ident/model/vehicle.h"

namespace ident {

enum class EffectId : int {
#define IDENT_EFFECT(file, Type) file,
#include "ident/effects/effects.def"
#undef IDENT_EFFECT
  count
};
constexpr int kEffectCount = static_cast<int>(EffectId::count);

namespace effects_detail {
/// Place of the first parameter of each effect in the parameter vector.
constexpr std::array<int, kEffectCount + 1> offsets() {
  std::array<int, kEffectCount + 1> places{};
  int next = param::base_count, i = 0;
#define IDENT_EFFECT(file, Type)                \
  places[static_cast<std::size_t>(i++)] = next; \
  next += static_cast<int>(Type::parameters.size());
#include "ident/effects/effects.def"
#undef IDENT_EFFECT
  places[kEffectCount] = next;
  return places;
}
}  // namespace effects_detail

constexpr auto kEffectOffset = effects_detail::offsets();
/// Length of the model's parameter vector.
constexpr int kParameterCount = kEffectOffset[kEffectCount];

/// An entry of the catalogue as data.
struct EffectEntry {
  EffectId id;
  EffectInfo info;
  std::span<const EffectParameter> parameters;
  int offset;   ///< of its first parameter in the parameter vector
  bool drives;  ///< acts on how rotors turn for their commands, not only on what turning rotors do
};

std::span<const EffectEntry> catalogue();
const EffectEntry& entry(EffectId id);
/// Entry of that name, or nullptr.
const EffectEntry* find_effect(std::string_view name);
/// Parameter of an effect by its full name (rotor_drag.kd), or nullptr.
const EffectParameter* find_effect_parameter(std::string_view full_name);

/// Null values of the effects and defaults of the base constants.
std::vector<double> null_parameters();

/// Parameter vector of a vehicle: what it states, defaults elsewhere. Throws UsageError when mass, inertia or
/// kT, without which nothing moves, is missing or not positive.
std::vector<double> parameter_vector(const Vehicle& vehicle);

/// A set of effects as bits, by EffectId.
using EffectMask = std::uint32_t;
constexpr EffectMask mask_of(EffectId id) { return EffectMask{1} << static_cast<int>(id); }
/// Those with a parameter off its null value.
EffectMask active_effects(std::span<const double> p);

/// Enters the active effects into the model; `p` is the whole parameter vector and must outlive the object.
template <class S>
class EffectSet {
 public:
  EffectSet(std::span<const S> p, EffectMask active) : p_(p.data()), active_(active) {
    int i = 0;
#define IDENT_EFFECT(file, Type) \
  if (active_ >> i++ & 1U) touches_ |= Type::info.touches;
#include "ident/effects/effects.def"
#undef IDENT_EFFECT
  }

  template <class Seam>
  void apply(Seam& seam) const {
    if (active_ == 0) return;
    int i = 0;
#define IDENT_EFFECT(file, Type)                                                               \
  if constexpr (requires(const S* q) { Type::apply(q, seam); }) {                              \
    if (active_ >> i & 1U) Type::apply(p_ + kEffectOffset[static_cast<std::size_t>(i)], seam); \
  }                                                                                            \
  ++i;
#include "ident/effects/effects.def"
#undef IDENT_EFFECT
  }

  unsigned touches() const { return touches_; }

 private:
  const S* p_;
  EffectMask active_;
  unsigned touches_ = 0;
};

}  // namespace ident
