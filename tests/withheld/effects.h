// What the true vehicle has beyond the base model: the effects of a case in the generator's own forms.
#pragma once

#include <Eigen/Dense>
#include <string>

namespace withheld {

// Every member is at its null value by default: then the vehicle is exactly the base model.
struct Effects {
  double drag = 0;                       // kg/rad, rotor drag at each hub
  bool drag_follows_inflow = false;      // part of it scales with the local inflow, as blade elements have it
  double body_drag = 0;                  // N s^2/m^2
  double body_drag_z = 1;                // the same across the plate, relative to along it
  double lift_gain = 0;                  // share of thrust won when forward flight blows the inflow away
  double inflow = 0;                     // kg/rad, thrust lost per axial flow through the disc
  double flap_moment = 0;                // N s^2/rad, hub moment per speed and rotor speed
  double flap_tilt = 0;                  // kg/rad, force of the thrust that tilts back with the disc
  double ground = 0;                     // strength of the image sources, 1 is the isolated rotors' theory
  Eigen::Vector3d wind{0, 0, 0};         // m/s, mean, world frame
  double sag = 0;                        // exponent of voltage in the speed per command
  double command_delay = 0;              // s
  double sensor_delay = 0;               // s, of rates and attitude
  double slow_spin_down = 0;             // 1 - ratio of motor frequencies down to up
  double thrust_power = 0;               // thrust goes with Omega^(2 + thrust_power), equal at hover
  Eigen::Vector4d weakness{0, 0, 0, 0};  // thrust and torque lost, a share for each rotor
  Eigen::Matrix<double, 2, 4> tilt = Eigen::Matrix<double, 2, 4>::Zero();  // rad, turn of axes about x, y
  double Jp = 0;                                                           // kg m^2
  Eigen::Vector3d cg{0, 0, 0};                                             // m from the origin
  double payload = 0;                                                      // kg
  Eigen::Vector3d payload_at{0, 0, 0};
  Eigen::Vector3d products{0, 0, 0};  // kg m^2, Jxy, Jxz, Jyz
  Eigen::Vector3d acc_bias{0, 0, 0};  // m/s^2
  Eigen::Vector3d imu_at{0, 0, 0};    // m
  Eigen::Vector3d imu_turn{0, 0, 0};  // rad, rotation vector from body to IMU axes

  // Outside the catalogue.
  double slung_mass = 0, slung_length = 1;  // kg (in the stated mass), m
  double slosh_share = 0, slosh_rate = 6;   // of the mass, rad/s
  double arm_flex = 0, arm_rate = 50;       // share of thrust that passes the flexible arm, rad/s
  double imbalance = 0;                     // kg m, mass times offset of one rotor's blades
  double vortex_ring = 0;                   // share of thrust lost in the worst descent
  double downwash = 0;                      // N/kg at the peak of a burst
  double backlash = 0;                      // width of the dead band of the command

  // The gust's grip on a vehicle that has no modelled drag: light turbulence is there in any case.
  double gust_grip = 0;  // 1/s per mass
  double gust_arm = 0;   // m above the origin
};

}  // namespace withheld
