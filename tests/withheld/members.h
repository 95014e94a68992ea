// A member of a case: one effect (or wrong parameter) with its direction drawn and its size still open.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "effects.h"
#include "flight_plan.h"
#include "random.h"
#include "vehicle.h"

namespace withheld {

struct Member {
  std::string name;            // as in the catalogue, `parameter:kT`, or the name of something outside
  std::string form = "exact";  // the equation against the catalogue's: exact, near (same first order), other
  int freedom = 1;             // continuous parameters that a diagnosis has to estimate
  // Puts the effect into the truth; size 1 is the upper end of what is typical.
  std::function<void(Effects&, double)> apply = [](Effects&, double) {};
  // The catalogue's parameters at that size.
  std::function<std::map<std::string, double>(double)> parameters = [](double) {
    return std::map<std::string, double>{};
  };
  // Effects that come along because this one acts through them or with them.
  std::vector<std::string> accompanying;
  std::function<void(Effects&)> accompany = [](Effects&) {};
  std::string wrong_parameter;  // of the base model: the file states truth times exp(sign * size * reach)
  double wrong_reach = 0;
  PlanSettings plan;        // manoeuvres without which the effect cannot be seen
  double delay_margin = 0;  // s at size 1
};

// Names of the 21 effects; of what lies outside; of base parameters that may be wrong.
const std::vector<std::string>& catalogue_names();
const std::vector<std::string>& outside_names();
const std::vector<std::string>& wrong_parameter_names();

// Whether it is somewhere between command and rotor speed: logs of speeds alone cannot show it.
bool acts_before_rotor_speed(const std::string& name);

Member draw_member(const std::string& name, const Vehicle& vehicle, Random& random);

// Parts of draw_member, one for each group.
bool draw_air_member(const std::string& name, const Vehicle& vehicle, Random& random, Member* member);
bool draw_drive_member(const std::string& name, const Vehicle& vehicle, Random& random, Member* member);
bool draw_body_member(const std::string& name, const Vehicle& vehicle, Random& random, Member* member);
bool draw_sensor_member(const std::string& name, const Vehicle& vehicle, Random& random, Member* member);
bool draw_outside_member(const std::string& name, const Vehicle& vehicle, Random& random, Member* member);
bool draw_wrong_parameter(const std::string& name, Random& random, Member* member);

}  // namespace withheld
