// The fixed set of references that every vehicle flies: quick moves, a figure eight, a fast straight.
#pragma once

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

namespace mended {

struct Aim {
  Eigen::Vector3d p{0, 0, 0}, v{0, 0, 0}, a{0, 0, 0};  // north, west, up; yaw stays 0
};

struct References {
  // Sizes for a vehicle whose attitude loop may have `bandwidth` rad/s.
  explicit References(double bandwidth);
  Aim at(double t) const;
  // What is flown at a time: "settle", "steps", "figure eight", "straight".
  const std::string& name(double t) const;
  double end() const { return segments_.back().end; }

 private:
  using Shape = std::function<Aim(double)>;  // of the time since its start
  struct Segment {
    std::string name;
    double start, end;
    Shape shape;
  };
  void add(const std::string& name, double length, Shape shape);
  void add_move(const std::string& name, const Eigen::Vector3d& by, double length, double rest);
  void add_eight(double size, double rate);

  std::vector<Segment> segments_;
  Eigen::Vector3d place_{0, 0, 5};
};

}  // namespace mended
