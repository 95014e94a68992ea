// What is flown: a sequence of manoeuvres as set-points over time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "vehicle.h"

namespace field {

struct SetPoint {
  Vector3d p_W = Vector3d::Zero(), v_W = Vector3d::Zero(), a_W = Vector3d::Zero();
  double yaw = 0, yaw_rate = 0;        // rad, rad/s
  Vector3d tilt_B = Vector3d::Zero();  // rad, added to the attitude: doublets
};

// What a vehicle may be asked for.
struct FlightLimits {
  double speed = 0, climb = 0, sink = 0;  // m/s
  double room = 0;                        // m, size of figures
  double height = 0;                      // m above ground
  double low = 0;                         // m, height of low passes; 0: none
  double tilt = 0;                        // rad, of doublets
};

class FlightPlan {
 public:
  // `style` 0, 1, 2: which manoeuvres the flight leans on.
  FlightPlan(Random& random, const FlightLimits& limits, double duration, int style);
  SetPoint at(double t) const;
  const std::vector<std::string>& names() const { return names_; }

 private:
  struct Segment {
    double from, length;
    SetPoint start;
    std::function<SetPoint(double)> offset;  // from start, of the time within
  };
  void add(std::string name, double length, std::function<SetPoint(double)> offset);

  std::vector<Segment> segments_;
  std::vector<std::string> names_;
};

}  // namespace field
