// What is physics about a cause: stated here once, so that a diagnosis knows no cause by its name.
#pragma once

#include <span>
#include <string_view>

namespace ident {

/// Traits of an effect, or of a wrong value of a constant (`parameter:NAME`).
struct CauseTraits {
  std::string_view name;
  bool moves_mass = false;    ///< changes mass, inertia or centre of gravity, as something bolted on does
  bool of_mounting = false;   ///< of how a sensor sits: it changes readings, not the flight
  bool of_drive = false;      ///< thrust per command: no two packs and propellers follow one law
  bool of_motors = false;     ///< of how rotor speed follows its command; motors follow their equation nearly
  bool of_lag = false;        ///< one of the two constants of the motors' lag, which are one cause
  bool of_battery = false;    ///< shows in thrust over voltage without any other model
  bool per_rotor = false;     ///< each rotor may have a size of its own
  bool bolted_on = false;     ///< a mass at a place: mass, inertia and centre of gravity at once
  bool carries_air = false;   ///< a drag: moving air acts through it
  bool by_the_air = false;    ///< moves the air: acts through what carries it
  bool between_rows = false;  ///< what a controller does between two logged commands passes for it
  /// Causes that come with it: naming both says one thing twice.
  std::span<const std::string_view> implies = {};
  /// What it is where it is small: a payload too light to be weighed is a shifted centre of gravity.
  std::string_view alias_of = {};
};

/// Of a cause without any trait as well.
const CauseTraits& traits_of(std::string_view cause);

/// Whether `cause` brings `other` along.
bool implies(std::string_view cause, std::string_view other);

/// Causes with traits, in no order: a test holds that each is an effect or a constant of the model.
std::span<const CauseTraits> all_cause_traits();

}  // namespace ident
