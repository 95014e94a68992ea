// The seams at which an effect may enter the flight model: what it sees there and what it may change.
#pragma once

#include "ident/core/math.h"

namespace ident {

/// Seam `mass`: properties of the body before they are used.
template <class S>
struct MassSeam {
  S m;          ///< kg
  Mat3<S> J;    ///< about the centre of gravity, kg m^2
  Vec3<S> c_B;  ///< centre of gravity from the origin, m
  S Jp;         ///< one propeller with its rotating motor parts, kg m^2
};

/// Seam `drive`: how a command becomes a rotor speed.
template <class S>
struct DriveSeam {
  double t = 0.0;            ///< s from the start of the log
  double voltage_ratio = 1;  ///< battery voltage over the voltage at which km holds; 1 when not logged
  bool has_voltage = false;
  S gain;        ///< factor on the steady rotor speed, starts at 1
  S down_ratio;  ///< omega_m while slowing down over omega_m while speeding up, starts at 1
};

/// Seam `air`: the wind, world frame, m/s.
template <class S>
struct AirSeam {
  Vec3<S> wind_W;
};

/// Seam `rotor`: one rotor in its flow. Forces act at the hub. What an effect does not say that it touches
/// need not be set.
template <class S>
struct RotorSeam {
  int index = 0;                          ///< 0 for the first rotor
  const S* per_Omega_hover = nullptr;     ///< inverse of the nominal rotor speed at hover, s/rad
  const Eigen::Vector3d* axis = nullptr;  ///< the thrust axis where it is a constant
  S Omega;                                ///< rad/s
  Vec3<S> v_air_B;                        ///< air-relative velocity of the hub, m/s
  S height;                               ///< of the hub above the ground, m
  Vec3<S> a_B;                            ///< thrust axis; may be turned
  S T, Q;                                 ///< thrust N and drag torque N m; may be changed
  Vec3<S> F_B, M_B;                       ///< further force, N, and hub moment, N m; start at zero

  /// Speed of the hub along the thrust axis.
  S along() const {
    if (!axis) return dot(v_air_B, a_B);
    S v = (*axis)[2] * v_air_B[2];
    for (int i = 0; i < 2; ++i)
      if ((*axis)[i] != 0) v = sum(v, (*axis)[i], v_air_B[i]);
    return v;
  }
  /// Velocity of the hub across the disk.
  Vec3<S> across() const {
    const S v = along();
    if (!axis) return v_air_B - v * a_B;
    Vec3<S> rest = v_air_B;
    for (int i = 0; i < 3; ++i)
      if ((*axis)[i] != 0) rest[i] = sum(rest[i], -(*axis)[i], v);
    return rest;
  }
};

/// Seam `body`: the airframe as a whole, forces at the centre of gravity.
template <class S>
struct BodySeam {
  Vec3<S> v_air_B;
  Vec3<S> F_B, M_B;
};

/// Seam `sensor`: what the IMU shows, starting from the truth at the origin.
template <class S>
struct SensorSeam {
  Vec3<S> w_B, w_dot_B;  ///< body rates and their derivative, truth
  Vec3<S> f_B;           ///< specific force, m/s^2; may be changed
  Vec3<S> gyro;          ///< rates as shown, rad/s; may be changed
};

/// Seam `time`: delays, s.
template <class S>
struct TimeSeam {
  S command_delay;  ///< of the motors' command
  S sensor_delay;   ///< of rates and attitude
};

/// What an active effect touches, so that the model computes no more than it must.
enum Touch : unsigned {
  kTouchFlow = 1,       ///< rotor, body or air seam: needs the velocity through the air
  kTouchCentre = 2,     ///< centre of gravity off the origin
  kTouchSpin = 4,       ///< momentum of the rotors
  kTouchAsymmetry = 8,  ///< spin-down differs from spin-up
  kTouchGain = 16,      ///< rotor speed per command
  kTouchRotor = 32,     ///< rotor seam: thrust or torque
  kTouchHeight = 64,    ///< needs the height above the ground
  kTouchAxis = 128,     ///< turns the thrust axis
  kTouchHub = 256,      ///< adds a force or moment at the hub
  kTouchImuFrame = 512  ///< turns what the accelerometer shows
};

/// The model without any effect: every seam is left as it is.
struct NoEffects {
  template <class Seam>
  void apply(Seam&) const {}
  static constexpr unsigned touches() { return 0; }
};

}  // namespace ident
