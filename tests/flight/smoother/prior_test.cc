// What is known of constants together: as a quadratic form, and as what one log tells the next.
#include "ident/flight/smoother/prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ident/core/random.h"
#include "ident/flight/refine.h"
#include "ident/flight/refine_without_motor_cutoff.h"
#include "ident/io/vehicle/vehicle_file.h"
#include "ident/io/vehicle/vehicle_write.h"
#include "support/known_quad.h"

namespace ident {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// kT and km to a fifth, kT km^2 a hundred times better; the dead time, which moves by itself, with omega_m.
Vehicle known_together() {
  Vehicle v = testing::known(testing::quad());
  v.parameters["kT"].std = 0.2 * v.value("kT");
  v.parameters["km"].std = 0.1 * v.value("km");
  v.correlation.names = {"kT", "km", "omega_m", "dead_time"};
  v.correlation.matrix = MatrixXd::Identity(4, 4);
  v.correlation.matrix(0, 1) = v.correlation.matrix(1, 0) = -1 + 0.5e-4;
  v.correlation.matrix(2, 3) = v.correlation.matrix(3, 2) = 0.7;
  return v;
}

Theta theta_of(const Vehicle& v) {
  const std::vector<double> p = parameter_vector(v);
  return {p, free_constants(v, p), 1, true};
}

int slot(const Theta& theta, const std::string& name) {
  for (int i = 0; i < theta.size(); ++i)
    if (theta.name(i) == name) return i;
  throw std::out_of_range(name);
}

VectorXd somewhere(const Theta& theta, double size) {
  Random random(3);
  return VectorXd::NullaryExpr(theta.size(), [&](Eigen::Index) { return size * random.normal(); });
}

TEST(FlightPrior, IsTheQuadraticFormOfTheCovariance) {
  const Vehicle v = known_together();
  const Theta theta = theta_of(v);
  const VectorXd u = somewhere(theta, 0.01);
  const PriorTerms prior = theta.prior(u);
  const int T = slot(theta, "kT"), M = slot(theta, "km"), W = slot(theta, "omega_m"),
            D = slot(theta, "dead_time"), Q = slot(theta, "kQ");
  double sum = 0;
  const auto pair = [&](int a, double sa, int b, double sb, double r) {
    const Eigen::Matrix2d C{{sa * sa, r * sa * sb}, {r * sa * sb, sb * sb}};
    const auto off = [&](int i) {
      return i == D ? theta.physical(u, i) - v.value("dead_time") : u[i];  // logarithms else
    };
    const Eigen::Vector2d x(off(a), off(b));
    sum += x.dot(C.inverse() * x);
  };
  pair(T, 0.2, M, 0.1, -1 + 0.5e-4), pair(W, 0.08, D, 0.001, 0.7);
  for (int i = 0; i < theta.size(); ++i)
    if (i != T && i != M && i != W && i != D) sum += std::pow(prior.residual[i], 2);
  EXPECT_NEAR(prior.cost(), sum, 1e-6 * sum);
  EXPECT_NEAR(prior.residual[Q], (std::exp(u[Q]) - 1) / 0.08, 1e-9) << "known by itself: as before";
}

TEST(FlightPrior, SlopesRootAndStepsAreThoseOfItsCost) {
  const Theta theta = theta_of(known_together());
  const VectorXd u = somewhere(theta, 0.02);
  const PriorTerms prior = theta.prior(u);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < theta.size(); ++i) {
    const VectorXd step = kStep * VectorXd::Unit(theta.size(), i);
    const double difference = (theta.prior(u + step).cost() - theta.prior(u - step).cost()) / (4 * kStep);
    EXPECT_NEAR(prior.gradient()[i], difference, 1e-6 * (1 + std::abs(difference))) << theta.name(i);
  }
  const MatrixXd H = prior.information(), R = prior.root();
  EXPECT_LT((R.transpose() * R - H).norm(), 1e-9 * H.norm());
  EXPECT_NEAR(prior.whitened().squaredNorm(), prior.cost(), 1e-9 * prior.cost());
  EXPECT_LT((R.transpose() * prior.whitened() - prior.gradient()).norm(), 1e-9 * prior.gradient().norm());
  const VectorXd step = somewhere(theta, 1e-3);
  EXPECT_NEAR(prior.cost_after(step), prior.cost() + 2 * prior.gradient().dot(step) + step.dot(H * step),
              1e-6);
}

// As far as a fifth and a tenth go: along the product that is known it costs what each alone does, 4 standard
// deviations across it.
TEST(FlightPrior, AKnownProductIsALineInLogarithms) {
  const Theta theta = theta_of(known_together());
  const int T = slot(theta, "kT"), M = slot(theta, "km");
  const double before = theta.prior(VectorXd::Zero(theta.size())).cost();
  VectorXd u = VectorXd::Zero(theta.size());
  u[T] = 0.4, u[M] = -0.2;
  EXPECT_NEAR(theta.prior(u).cost() - before, 4.0, 0.01);
  u[M] = -0.2 + 0.5 * 4 * 0.002;  // kT km^2 four of its deviations off
  EXPECT_NEAR(theta.prior(u).cost() - before, 20.0, 0.5);
}

// As a wrong value that is freed of what was stated of it: it must not be held by its partner.
TEST(FlightPrior, ALoosenedUnknownIsIndependentOfTheOthers) {
  const Theta theta = theta_of(known_together());
  const int T = slot(theta, "kT"), M = slot(theta, "km"), W = slot(theta, "omega_m"),
            D = slot(theta, "dead_time");
  const PriorTerms stated = theta.prior(VectorXd::Zero(theta.size())), prior = stated.loosened(T, 100.0);
  MatrixXd held = prior.information(1e-12);
  held(M, M) += 1e12;  // a flight that tells km
  EXPECT_NEAR(std::sqrt(MatrixXd(held.inverse())(T, T)), 20.0, 0.01);
  EXPECT_NEAR(std::sqrt(MatrixXd(prior.information(1e-12).inverse())(M, M)), 0.1, 1e-4);
  EXPECT_NEAR(prior.information()(W, D), stated.information()(W, D),
              1e-9 * std::abs(stated.information()(W, D)));
  const PriorTerms more = prior.extended(theta.size() + 2);
  EXPECT_EQ(more.cost(), prior.cost());
  EXPECT_EQ(more.information().bottomRightCorner(2, 2), MatrixXd::Identity(2, 2));
}

// The same of constants: one that is held where it was stated leaves what is known of the others as it was.
TEST(FlightPrior, AnUncorrelatedUnknownPullsNoOther) {
  const Vehicle v = known_together();
  const std::vector<double> p = parameter_vector(v);
  std::vector<FreeConstant> constants = free_constants(v, p);
  know_alone(constants, param::kT);
  for (FreeConstant& c : constants)
    if (c.index == param::kT) *c.prior_std *= 1e-3;
  const Theta theta(p, constants, 1, true);
  VectorXd u = VectorXd::Zero(theta.size());
  u[slot(theta, "kT")] = 2e-4;  // one deviation, of a fifth and a thousandth of that
  const PriorTerms prior = theta.prior(u);
  EXPECT_NEAR(prior.cost(), 1.0, 1e-3);
  EXPECT_EQ(prior.gradient()[slot(theta, "km")], 0.0);
  EXPECT_NE(prior.precision(slot(theta, "omega_m"), slot(theta, "dead_time")), 0.0) << "another pair stays";
}

// Where nothing goes together worth the name, priors are as they were: normal in their values.
TEST(FlightPrior, AWeakCorrelationKeepsPhysicalCoordinates) {
  Vehicle v = known_together();
  v.correlation = {{"kT", "km"}, Eigen::Matrix2d{{1, 1e-5}, {1e-5, 1}}};
  const Theta theta = theta_of(v);
  VectorXd u = VectorXd::Zero(theta.size());
  u[slot(theta, "kT")] = 0.4;
  EXPECT_NEAR(theta.prior(u).residual[slot(theta, "kT")], (std::exp(0.4) - 1) / 0.2, 1e-9);
}

// Constants that a log has no say in are left out: what remains is known as it was with them.
TEST(FlightPrior, RemovingConstantsLeavesTheOtherPriorsUnchanged) {
  const Vehicle v = known_together();
  const std::vector<double> p = parameter_vector(v);
  std::vector<FreeConstant> constants = free_constants(v, p);
  leave_out_motors(constants);
  const Theta theta(p, constants, 1, true);
  const VectorXd u = VectorXd::Zero(theta.size());
  const int T = slot(theta, "kT");
  EXPECT_NEAR(theta.prior(u).information()(T, T), 25.0, 1e-9);
}

TEST(FlightPrior, InverseCorrelationIsBoundedByRounding) {
  const MatrixXd inverse = inverse_correlation(MatrixXd{{1, 1}, {1, 1}});
  EXPECT_TRUE(inverse.allFinite());
  EXPECT_NEAR(inverse(0, 0), 0.5e10, 1e4);
}

// Two logs one after the other, the first stored and read in between, tell what both tell at once. Without
// rotor speeds kT km^2 is known and nothing alone, and that as well as the mass; by their deviations only,
// the mass that the first log was weighed with would count a second time.
TEST(FlightPrior, SequentialRefinementEqualsJointRefinement) {
  const Vehicle truth = testing::quad();
  Vehicle stated = testing::known(truth);
  for (const char* name : {"kT", "kQ", "km"}) stated.parameters[name].value *= 1.04;
  std::vector<FlightLog> logs{testing::flight(truth, 250, 1, 15.0), testing::flight(truth, 250, 2, 15.0)};
  for (FlightLog& log : logs) log.Omega.clear();
  const auto refined = [](const Vehicle& v, std::span<const FlightLog> of) {
    return refine_flight(v, of, {.validate = false});
  };
  const Result both = refined(stated, logs);
  const auto after = [&](bool together) {
    Vehicle stored = with_parameters(stated, with_result({}, refined(stated, std::span(logs).first(1))));
    if (!together) stored.correlation = {};
    return refined(stored, std::span(logs).last(1));
  };
  const auto thrust = [](const Result& r) {
    const Parameter &kT = *r.find("kT"), &km = *r.find("km");
    const double a = kT.std / kT.value, b = 2 * km.std / km.value;
    return std::pair{std::log(kT.value * km.value * km.value),
                     std::sqrt(a * a + b * b + 2 * a * b * r.correlation.of("kT", "km"))};
  };
  const Result one_by_one = after(true), by_deviations = after(false);
  EXPECT_NEAR(thrust(one_by_one).first, thrust(both).first, 0.1 * thrust(both).second);
  EXPECT_NEAR(thrust(one_by_one).second / thrust(both).second, 1.0, 0.02);
  EXPECT_LT(thrust(by_deviations).second / thrust(both).second, 0.75);
  for (const Parameter& p : both.parameters) {
    const Parameter* q = one_by_one.find(p.name);
    ASSERT_TRUE(q);
    EXPECT_NEAR(q->value, p.value, 0.3 * p.std) << p.name;
    EXPECT_NEAR(q->std / p.std, 1.0, 0.2) << p.name;
  }
}

// kT km^2 of an earlier flight is 6 % off, thirty of its deviations: neither of the two is,
// by what is known of it alone. Both are named, with each other; what neither has to do with is not.
TEST(FlightPrior, AContradictedProductIsReportedForBothConstants) {
  const Vehicle truth = testing::quad();
  Vehicle stated = known_together();
  stated.parameters["kT"] = {1.06 * truth.value("kT"), 1.06 * 0.2 * truth.value("kT")};
  FlightLog log = testing::flight(truth, 250, 1, 15.0);
  log.Omega.clear();
  const Result result = refine_flight(stated, std::span(&log, 1), {.validate = false});
  for (const char* name : {"kT", "km"}) {
    const Parameter* p = result.find(name);
    ASSERT_TRUE(p && p->pull) << name;
    EXPECT_GT(std::abs(*p->pull), 4.0) << name;
    EXPECT_LT(std::abs(p->value - *p->prior_value), *p->prior_std) << name;
  }
  EXPECT_LT(std::abs(*result.find("omega_m")->pull), 3.0);
  const auto says = [&](const std::string& part) {
    return std::ranges::any_of(result.warnings, [&](const Warning& w) {
      return w.code == "prior_disagrees" && w.message.find(part) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("beforehand, together with km, was"));
}

}  // namespace
}  // namespace ident
