// What a simulator's file can hold of a vehicle, stated by each format.
#pragma once

#include <Eigen/Core>
#include <set>
#include <string_view>
#include <vector>

namespace ident {

/// One rotor of a fixed layout: where it sits (signs of x and y, FRD) and how it spins.
struct FixedRotor {
  int x, y, spin;
};

struct Capacity {
  enum class Centre { own, by_positions, none };
  enum class Motor { full, first_order, instant };

  bool products = true;         ///< products of inertia
  Centre centre = Centre::own;  ///< centre of gravity off the origin: own entry, or hubs moved against it
  bool tilted_axes = true;      ///< thrust axes other than straight up
  bool heights = true;          ///< hubs above or below the centre of gravity
  bool each_rotor = false;      ///< kT and kQ of each rotor by itself
  Motor motor = Motor::first_order;  ///< of the rotor's speed, or of its thrust
  bool up_and_down = false;          ///< another lag while slowing down
  bool dead_time = false;
  bool idle_speed = false;      ///< Omega_0
  bool rotor_momentum = false;  ///< Jp
  double least_momentum = 0.0;  ///< Jp over Jzz below which the file cannot go
  bool as_published = false;    ///< the printed signs of [Phang 16, 18, 19]
  bool ground = false, air_density = false, battery = false;
  std::vector<FixedRotor> layout;        ///< the only layout, in this order; empty: any
  std::set<std::string_view> constants;  ///< further constants kept as they are: Kdx, rotor_drag.kd, ...
  std::set<std::string_view> replaced;   ///< constants for which others stand: the format's remarks say so
  std::vector<const char*> needs;        ///< constants without which no such file can be written
  bool rotor_speeds = true;  ///< false: speed at full command is assumed, only kT km^2 and kQ km^2 count
  bool everything = false;   ///< nothing is left out or changed
};

}  // namespace ident
