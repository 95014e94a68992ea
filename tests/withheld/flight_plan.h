// What the pilot flies: a sequence of manoeuvres, each a reference over time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "random.h"
#include "vehicle.h"

namespace withheld {

struct Reference {
  Eigen::Vector3d p{0, 0, 0}, v{0, 0, 0}, a{0, 0, 0};  // world frame
  double yaw = 0, yaw_rate = 0;
  Four injected = Four::Zero();  // added to the normalised commands
};

struct PlanSettings {
  double duration = 45;                                               // s
  double liveliness = 1;                                              // 0.5 gentle to 1.5 brisk
  bool near_ground = false, fast_descent = false, multisine = false;  // a manoeuvre of this kind for certain
};

class FlightPlan {
 public:
  FlightPlan(const Vehicle& vehicle, const PlanSettings& settings, Random random);
  Reference at(double t) const;
  const std::vector<std::string>& manoeuvres() const { return names_; }

 private:
  using Shape = std::function<Reference(double)>;  // of the time since its start
  struct Segment {
    double start, end;
    Shape shape;
  };

  void add(const std::string& name, double length, Shape shape);
  void add_named(const std::string& name, const Vehicle& vehicle, double liveliness, Random& random);
  void add_multisine(const Vehicle& vehicle, double liveliness, Random& random);
  void add_doublets(const Vehicle& vehicle, double liveliness, Random& random);
  void add_steps(const Vehicle& vehicle, double liveliness, Random& random);
  void add_heights(const Vehicle& vehicle, double liveliness, Random& random);
  void add_low_pass(const Vehicle& vehicle, Random& random);
  void add_descents(const Vehicle& vehicle, Random& random);
  void add_eight(double liveliness, Random& random);
  void add_leg(double liveliness, Random& random);
  void add_turn(Random& random);

  std::vector<Segment> segments_;
  std::vector<std::string> names_;
  Reference rest_;     // where the next manoeuvre begins
  double cruise_ = 4;  // m/s
  double quick_ = 1;   // attitude bandwidth relative to the quickest vehicles'
};

}  // namespace withheld
