// One automatic cost function a segment.
#include "plain_fit.h"

#include <ceres/ceres.h>

#include <chrono>
#include <cmath>

namespace ident {
namespace {

struct Row {
  std::size_t at;
  int channel;
};

struct Segment {
  const FlightRecord* record;
  const FlightArc* arc;
  const Theta* theta;
  std::size_t begin, end;
  int residuals = 0;

  template <class T>
  bool operator()(const T* u, const T* s, T* r) const {
    const double *t = arc->t.data(), *y = arc->y.data();
    std::vector<T> p;
    for (const double x : theta->p(Eigen::VectorXd::Zero(theta->size()))) p.push_back(T(x));
    for (int i = 0; i < kPlainShared; ++i) {
      const FreeConstant& c = theta->constants()[static_cast<std::size_t>(i)];
      using std::exp;
      p[static_cast<std::size_t>(c.index)] =
          c.positive ? T(c.start * exp(u[i])) : T(c.start + c.scale * u[i]);
    }
    const EffectSet<T> none(p, 0);
    Flight<T, EffectSet<T>> flight(*record->vehicle, p, none, *arc->inputs);
    FlightState<T> x = start(s);
    BodyRate<T> rate = flight.rate(x, t[begin]);
    for (std::size_t i = begin; i < end; ++i) {
      const auto add = [&](int channel, const T& predicted) {
        const double measured = y[i * kChannels + static_cast<std::size_t>(channel)];
        if (measured == measured)
          *r++ = (predicted - measured) / record->sigma[static_cast<std::size_t>(channel)];
      };
      const double* m = arc->q.data() + 4 * i;
      const Vec4<T> turn = quaternion_product(Vec4<T>(T(m[0]), T(-m[1]), T(-m[2]), T(-m[3])), x.body.q_WB);
      const double sign = value(turn[0]) < 0 ? -2.0 : 2.0;
      for (int k = 0; k < 3; ++k) {
        add(kGyro + k, x.body.w_B[k]), add(kForce + k, rate.f_B[k]);
        add(kVelocity + k, x.body.v_W[k]), add(kPosition + k, x.body.x_W[k]);
        add(kAttitude + k, sign * turn[1 + k]);
      }
      const int parts = 1 + static_cast<int>((t[i + 1] - t[i]) / kEstimatorStep);
      const double h = (t[i + 1] - t[i]) / parts;
      for (int part = 0; part < parts; ++part) flight.step_on(x, t[i] + part * h, h, rate);
    }
    return true;
  }

  template <class T>
  FlightState<T> start(const T* s) const {
    const FlightState<double> x = arc->start(begin);
    FlightState<T> state;
    const Vec4<T> half(T(1.0), 0.5 * s[3], 0.5 * s[4], 0.5 * s[5]);
    const T length = sqrt(T(1.0) + half[1] * half[1] + half[2] * half[2] + half[3] * half[3]);
    const Vec4<T> from(T(x.body.q_WB[0]), T(x.body.q_WB[1]), T(x.body.q_WB[2]), T(x.body.q_WB[3]));
    const Vec4<T> turned = quaternion_product(from, half);
    for (int k = 0; k < 4; ++k) state.body.q_WB[k] = turned[k] / length;
    for (int k = 0; k < 3; ++k) {
      state.body.w_B[k] = x.body.w_B[k] + s[k];
      state.body.v_W[k] = x.body.v_W[k] + s[6 + k];
      state.body.x_W[k] = x.body.x_W[k] + s[9 + k];
    }
    for (std::size_t n = 0; n < 4; ++n)
      state.motors[n] = {x.motors[n].Omega + s[12 + n], x.motors[n].Omega_dot + s[16 + n]};
    return state;
  }
};

struct Priors {
  const Theta* theta;
  template <class T>
  bool operator()(const T* u, T* r) const {
    for (int i = 0; i < kPlainShared; ++i) {
      const FreeConstant& c = theta->constants()[static_cast<std::size_t>(i)];
      using std::exp;
      const T x = c.positive ? T(c.start * exp(u[i])) : T(c.start + c.scale * u[i]);
      r[i] = c.prior_std ? T((x - c.prior_value) / *c.prior_std) : T(0.0);
    }
    return true;
  }
};

int count(const FlightArc& arc, std::size_t begin, std::size_t end) {
  int n = 0;
  for (std::size_t i = begin * kChannels; i < end * kChannels; ++i) n += std::isfinite(arc.y[i]) ? 1 : 0;
  return n;
}

}  // namespace

PlainFit fit_plainly(const FlightRecord& record, const Theta& theta, double seconds, double tolerance,
                     int threads) {
  const auto began = std::chrono::steady_clock::now();
  PlainFit out;
  out.u = Eigen::VectorXd::Zero(kPlainShared);
  ceres::Problem problem;
  std::vector<std::array<double, kPlainState>> states;
  states.reserve(10000);
  ceres::ParameterBlockOrdering* ordering = new ceres::ParameterBlockOrdering;
  for (const FlightArc& arc : record.arcs) {
    std::size_t begin = 0;
    while (begin + 1 < arc.rows()) {
      std::size_t end = begin + 1;
      while (end + 1 < arc.rows() && arc.t[end] - arc.t[begin] < seconds - 1e-9) ++end;
      if (arc.rows() - 1 - end < (end - begin) / 2) end = arc.rows() - 1;
      states.push_back({});
      const int n = count(arc, begin, end);
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Segment, ceres::DYNAMIC, kPlainShared, kPlainState>(
              new Segment{&record, &arc, &theta, begin, end, n}, n),
          nullptr, out.u.data(), states.back().data());
      ordering->AddElementToGroup(states.back().data(), 0);
      begin = end;
    }
  }
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<Priors, kPlainShared, kPlainShared>(new Priors{&theta}), nullptr,
      out.u.data());
  ordering->AddElementToGroup(out.u.data(), 1);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.linear_solver_ordering.reset(ordering);
  options.num_threads = threads;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = options.parameter_tolerance = 0;
  options.max_num_iterations = 50;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  out.cost = 2 * summary.final_cost;
  out.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps - 1;
  out.jacobian_seconds = summary.jacobian_evaluation_time_in_seconds;
  out.linear_seconds = summary.linear_solver_time_in_seconds;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return out;
}

}  // namespace ident
