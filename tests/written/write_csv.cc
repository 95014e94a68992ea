// The flight as CSV of FORMATS.md, a row for each run of the rate controller, or at 1 kHz where that is
// faster.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "case.h"

namespace written {
namespace {

// Where the controller runs faster than the rows, a row holds the mean of the commands up to the next row.
PerRotor mean_command(const Flight& flight, size_t k, size_t steps) {
  PerRotor sum{};
  size_t count = 0;
  for (size_t i = k; i < k + steps && i < flight.samples.size(); ++i, ++count)
    for (size_t n = 0; n < 4; ++n) sum[n] += flight.samples[i].motors.delta[n];
  for (double& value : sum) value /= static_cast<double>(count);
  return sum;
}

}  // namespace

void write_csv(const std::string& path, const Flight& flight, bool rotor_speeds) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) throw std::runtime_error("cannot write " + path);
  std::fputs("t,delta1,delta2,delta3,delta4,p,q,r,ax,ay,az,qw,qx,qy,qz,x,y,z,vx,vy,vz,vbat", file);
  std::fputs(rotor_speeds ? ",omega1,omega2,omega3,omega4\n" : "\n", file);
  const auto steps = static_cast<size_t>(std::max(4, flight.v.control_steps));
  for (size_t k = 0; k < flight.samples.size(); k += steps) {
    const Sample& s = flight.samples[k];
    const double t = static_cast<double>(k) * kStep;
    std::fprintf(file, "%.5f", t);
    for (const double delta : mean_command(flight, k, steps)) std::fprintf(file, ",%.6f", delta);
    for (const Vector3d& part : {s.gyro, s.accel})
      std::fprintf(file, ",%.6f,%.6f,%.6f", part.x(), part.y(), part.z());
    std::fprintf(file, ",%.7f,%.7f,%.7f,%.7f", s.q_WB.w(), s.q_WB.x(), s.q_WB.y(), s.q_WB.z());
    for (const Vector3d& part : {s.p_W, s.v_W})
      std::fprintf(file, ",%.5f,%.5f,%.5f", part.x(), part.y(), part.z());
    std::fprintf(file, ",%.3f", flight.voltage(t));
    if (rotor_speeds)
      for (const double Omega : s.truth.Omega) std::fprintf(file, ",%.0f", Omega);
    std::fputc('\n', file);
  }
  std::fclose(file);
}

}  // namespace written
