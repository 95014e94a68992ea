// Fourth-order Runge-Kutta from row to row; motors of first order are solved exactly, from the first row on.
#include "prediction.h"

#include <cmath>

namespace mended {

using Eigen::Quaterniond;

namespace {
Vector3d flipped(const Vector3d& x) { return {x.x(), -x.y(), -x.z()}; }
}  // namespace

TrueFlight::TrueFlight(const withheld::Flight& flight, const Vector3d& blowing) : wind(flipped(blowing)) {
  for (std::size_t k = 0; k < flight.truth.size(); ++k) {
    const withheld::Motion& m = flight.truth[k].motion;
    const withheld::Four& d = flight.rows[k].delta;
    t.push_back(flight.truth[k].t);
    delta.push_back({d[0], d[1], d[2], d[3]});
    v.push_back(flipped(m.v)), w.push_back(flipped(m.w));
    q.push_back(Quaterniond(m.q.w(), m.q.x(), -m.q.y(), -m.q.z()));
  }
}

std::size_t TrueFlight::rows_in(double seconds) const {
  const double period = (t.back() - t.front()) / static_cast<double>(t.size() - 1);
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(seconds / period)));
}

namespace {

struct Body {
  Vector3d v, w;  // of the centre of gravity, world; body
  Quaterniond q;
  Vector3d wind;  // world
};

// The numbers of target_model.h.
struct ByModel {
  const TargetModel& p;
  double m() const { return p.m; }
  double g() const { return p.g; }
  const Eigen::Matrix3d& J() const { return p.J; }
  const Eigen::Matrix3d& J_inverse() const { return p.J_inverse; }
  const Vector3d& c() const { return p.c; }
  void motors_after(const Motors& from, const Motors& delta, double h, Motors& out, Motors& rate) const {
    p.motors_after(from, delta, h, out, rate);
  }
  BodyWrench at(const Body& s, const Motors& x, const Motors& dot) const {
    return wrench(p, s.q.conjugate() * (s.v - s.wind), s.w, x, dot);
  }
};

// The equations of the tests.
struct ByEquations {
  const ident::test::SimulatorEquations& e;
  Eigen::Matrix3d inverse;
  Vector3d centre;
  double m() const { return e.m; }
  double g() const { return e.g; }
  const Eigen::Matrix3d& J() const { return e.J; }
  const Eigen::Matrix3d& J_inverse() const { return inverse; }
  const Vector3d& c() const { return centre; }
  void motors_after(const Motors& from, const Motors& delta, double h, Motors& out, Motors& rate) const {
    for (std::size_t n = 0; n < kRotors; ++n) {
      const double aim = e.target(delta[n], n), tau = from[n] > aim ? e.tau_down : e.tau_up;
      out[n] = tau > 0 ? aim + (from[n] - aim) * std::exp(-h / tau) : aim;
      rate[n] = tau > 0 ? (aim - out[n]) / tau : 0.0;
    }
  }
  BodyWrench at(const Body& s, const Motors& x, const Motors& dot) const {
    ident::test::SimulatorState state;
    state.v = s.v - s.wind, state.w = s.w, state.q = s.q;
    state.motors.assign(x.begin(), x.end());
    const auto out = e.wrench(state, {dot.begin(), dot.end()});
    return {out.F, out.M};
  }
};

struct Slope {
  Vector3d v, w;
  Eigen::Vector4d q;
};

template <class Plant>
Slope slope(const Plant& plant, const Body& s, const Motors& x, const Motors& dot) {
  const BodyWrench total = plant.at(s, x, dot);
  const Quaterniond turned = s.q * Quaterniond(0, s.w.x(), s.w.y(), s.w.z());
  return {s.q * total.F / plant.m() - Vector3d(0, 0, plant.g()),
          plant.J_inverse() * (total.M - s.w.cross(plant.J() * s.w)), 0.5 * turned.coeffs()};
}

Body moved(const Body& s, const Slope& k, double h) {
  Body next = s;
  next.v += h * k.v, next.w += h * k.w;
  next.q.coeffs() += h * k.q;
  return next;
}

template <class Plant>
void step(const Plant& plant, Body& s, Motors& x, const Motors& delta, double h) {
  Motors dot0, dot1, dot2, now, middle, end;
  plant.motors_after(x, delta, 0, now, dot0);
  plant.motors_after(x, delta, h / 2, middle, dot1);
  plant.motors_after(x, delta, h, end, dot2);
  const Slope k1 = slope(plant, s, x, dot0), k2 = slope(plant, moved(s, k1, h / 2), middle, dot1),
              k3 = slope(plant, moved(s, k2, h / 2), middle, dot1),
              k4 = slope(plant, moved(s, k3, h), end, dot2);
  s.v += h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v);
  s.w += h / 6 * (k1.w + 2 * k2.w + 2 * k3.w + k4.w);
  s.q.coeffs() += h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q);
  s.q.normalize();
  x = end;
}

Vector3d angle_between(const Quaterniond& from, const Quaterniond& to) {
  const Quaterniond turn = from.conjugate() * to;
  const Eigen::AngleAxisd angle(turn.w() < 0 ? Quaterniond(-turn.coeffs()) : turn);
  return angle.angle() * angle.axis();
}

std::size_t windows(const TrueFlight& f, const Horizon& horizon) {
  const std::size_t length = f.rows_in(horizon.length), every = f.rows_in(horizon.every);
  return f.t.size() > length ? (f.t.size() - length - 1) / every + 1 : 0;
}

std::size_t row_of(const TrueFlight& f, const Horizon& horizon, int sample) {
  return f.rows_in(horizon.length * (sample + 1) / horizon.samples);
}

template <class Plant>
Eigen::VectorXd residuals_of(const Plant& plant, const std::vector<TrueFlight>& flights,
                             const Horizon& horizon, const Errors& unit) {
  std::size_t count = 0;
  for (const TrueFlight& f : flights)
    count += windows(f, horizon) * static_cast<std::size_t>(horizon.samples);
  Eigen::VectorXd out(static_cast<Eigen::Index>(9 * count));
  Eigen::Index at = 0;
  for (const TrueFlight& f : flights) {
    std::vector<Motors> motors(f.t.size());
    Motors ignored;
    plant.motors_after(f.delta[0], f.delta[0], 1e6, motors[0], ignored);  // settled at the first command
    for (std::size_t k = 0; k + 1 < f.t.size(); ++k)
      plant.motors_after(motors[k], f.delta[k], f.t[k + 1] - f.t[k], motors[k + 1], ignored);
    const std::size_t every = f.rows_in(horizon.every);
    for (std::size_t window = 0; window < windows(f, horizon); ++window) {
      const std::size_t first = window * every;
      Body s{f.v[first] + f.q[first] * f.w[first].cross(plant.c()), f.w[first], f.q[first], f.wind};
      Motors x = motors[first];
      std::size_t k = first;
      for (int sample = 0; sample < horizon.samples; ++sample) {
        for (const std::size_t end = first + row_of(f, horizon, sample); k < end; ++k)
          step(plant, s, x, f.delta[k], f.t[k + 1] - f.t[k]);
        const Vector3d v = s.v - s.q * s.w.cross(plant.c());
        out.segment<3>(at) = (v - f.v[k]) / unit.v;
        out.segment<3>(at + 3) = angle_between(f.q[k], s.q) / unit.attitude;
        out.segment<3>(at + 6) = (s.w - f.w[k]) / unit.rate;
        at += 9;
      }
    }
  }
  // A model that runs away misses by a finite amount.
  return out.unaryExpr([](double x) { return std::isfinite(x) ? std::clamp(x, -1e3, 1e3) : 1e3; });
}

}  // namespace

Errors changes(const std::vector<TrueFlight>& flights, const Horizon& horizon) {
  Errors sum;
  double count = 0;
  for (const TrueFlight& f : flights) {
    for (std::size_t window = 0; window < windows(f, horizon); ++window) {
      const std::size_t first = window * f.rows_in(horizon.every);
      for (int sample = 0; sample < horizon.samples; ++sample) {
        const std::size_t k = first + row_of(f, horizon, sample);
        sum.v += (f.v[k] - f.v[first]).squaredNorm();
        sum.attitude += angle_between(f.q[first], f.q[k]).squaredNorm();
        sum.rate += (f.w[k] - f.w[first]).squaredNorm();
        ++count;
      }
    }
  }
  return {std::sqrt(sum.v / count), std::sqrt(sum.attitude / count), std::sqrt(sum.rate / count)};
}

Eigen::VectorXd residuals(const TargetModel& model, const std::vector<TrueFlight>& flights,
                          const Horizon& horizon, const Errors& unit) {
  return residuals_of(ByModel{model}, flights, horizon, unit);
}

Eigen::VectorXd residuals(const ident::test::SimulatorEquations& equations, const Vector3d& c,
                          const std::vector<TrueFlight>& flights, const Horizon& horizon,
                          const Errors& unit) {
  return residuals_of(ByEquations{equations, equations.J.inverse(), c}, flights, horizon, unit);
}

Errors rms(const Eigen::VectorXd& r, const Errors& unit) {
  Errors sum;
  for (Eigen::Index i = 0; i < r.size(); i += 9) {
    sum.v += r.segment<3>(i).squaredNorm(), sum.attitude += r.segment<3>(i + 3).squaredNorm();
    sum.rate += r.segment<3>(i + 6).squaredNorm();
  }
  const double n = static_cast<double>(r.size()) / 9;
  return {unit.v * std::sqrt(sum.v / n), unit.attitude * std::sqrt(sum.attitude / n),
          unit.rate * std::sqrt(sum.rate / n)};
}

double pooled(const Errors& e, const Errors& unit) {
  const Vector3d x(e.v / unit.v, e.attitude / unit.attitude, e.rate / unit.rate);
  return std::sqrt(x.squaredNorm() / 3);
}

}  // namespace mended
