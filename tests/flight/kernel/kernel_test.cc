// The flight kernel: every instruction set says the same, and its gradient is that of its cost.
#include "ident/flight/kernel/kernel.h"

#include <gtest/gtest.h>

#include "ident/effects/all_parameters.h"
#include "support/open_loop_flight.h"

namespace ident {
namespace {

TEST(FlightKernel, EveryInstructionSetGivesTheSame) {
  Setting s;
  std::vector<double> constants;
  const ChunkTask task = s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.01), constants);
  ChunkResult plain, other;
  ASSERT_TRUE(evaluate_chunk_with("baseline", task, plain));
  for (const char* isa : {"avx2", "avx512"}) {
    if (!evaluate_chunk_with(isa, task, other)) continue;
    EXPECT_NEAR(other.cost, plain.cost, 1e-9 * plain.cost) << isa;
    double largest = 0;
    for (const double a : plain.A) largest = std::max(largest, std::abs(a));
    for (std::size_t i = 0; i < plain.A.size(); ++i)
      ASSERT_NEAR(other.A[i], plain.A[i], 1e-7 * largest) << isa << " " << i;  // slopes in single precision
    for (std::size_t i = 0; i < plain.E.size(); ++i)
      ASSERT_NEAR(other.E[i], plain.E[i], 1e-5 * (1 + std::abs(plain.E[i]))) << isa;
  }
}

// The sum over samples of j P j' is the trace of P J'J; of many samples every third stands for its
// neighbours.
TEST(FlightKernel, LeveragesAddUpToTheTrace) {
  Setting s;
  std::vector<double> constants;
  ChunkTask task = s.task(Eigen::VectorXd::Zero(s.theta.size()), constants);
  task.huber = 1e9;
  const int n = s.record.layout.size;
  std::vector<double> P(static_cast<std::size_t>(n * n));
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) P[static_cast<std::size_t>(i * n + k)] = std::cos(i - k) / (1.0 + i + k);
  task.covariance = P.data();
  for (const auto& [few, to] : {std::pair{false, 1e-9}, {true, 0.01}})
    for (const char* isa : {"baseline", "avx2", "avx512"}) {
      task.few_leverages = few;
      ChunkResult r;
      if (!evaluate_chunk_with(isa, task, r)) continue;
      const int d = n + s.theta.size();
      double trace = 0, sum = 0;
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
          trace += P[static_cast<std::size_t>(i * n + k)] * r.A[static_cast<std::size_t>(k * d + i)];
      for (const double x : r.leverage) sum += x;
      EXPECT_NEAR(sum, trace, to * std::abs(trace)) << isa << (few ? ", few" : "");
      ChunkTask without = task;
      without.products = false;
      ChunkResult alone;
      evaluate_chunk_with(isa, without, alone);
      EXPECT_EQ(alone.leverage, r.leverage) << isa;
    }
}

// A payload's moment moves on its own, not its place: slopes and deviations are those of the product.
TEST(FlightKernel, AProductOfTwoConstantsHasItsSlopes) {
  Setting s;
  FreeConstant mass{.name = "payload.m", .index = find_parameter("payload.m")->index, .positive = true};
  FreeConstant place{.name = "payload.x", .index = find_parameter("payload.x")->index};
  mass.start = 0.03, place.start = 0.05, place.scale = 0.02, place.times = mass.index;
  s.theta = Theta(s.p, {mass, place}, 1, false);
  Eigen::VectorXd u = Eigen::Vector2d(0.4, -0.7);
  EXPECT_NEAR(s.theta.physical(u, 0) * s.theta.physical(u, 1), 0.03 * (0.05 - 0.7 * 0.02), 1e-15);
  const auto cost_at = [&](const Eigen::VectorXd& at, ChunkResult& r) {
    std::vector<double> constants;
    ChunkTask task = s.task(at, constants);
    task.exact = true, task.huber = 1e9;
    evaluate_chunk(task, r);
    return r.cost;
  };
  ChunkResult here, there;
  cost_at(u, here);
  const Eigen::MatrixXd C = Eigen::Matrix2d{{0.04, 0.01}, {0.01, 0.09}};
  Eigen::Vector2d gradient;
  for (int i = 0; i < 2; ++i) {
    constexpr double h = 1e-4;
    Eigen::VectorXd after = u, before = u;
    after[i] += h, before[i] -= h;
    const double slope = (cost_at(after, there) - cost_at(before, there)) / (2 * h);
    const double claimed = 2 * here.g[static_cast<std::size_t>(s.record.layout.size + i)];
    EXPECT_NEAR(claimed, slope, 1e-4 * std::abs(slope)) << i;
    gradient[i] = (s.theta.physical(after, 1) - s.theta.physical(before, 1)) / (2 * h);
  }
  EXPECT_NEAR(s.theta.deviation(u, 1, C), std::sqrt(gradient.dot(C * gradient)), 1e-9);
  EXPECT_NEAR(s.theta.deviation(u, 0, C), 0.2 * s.theta.physical(u, 0), 1e-12);
}

// Slopes in double precision are those in single precision, to its digits.
TEST(FlightKernel, ExactSlopesAgreeWithQuickOnes) {
  Setting s;
  std::vector<double> constants;
  ChunkTask task = s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.01), constants);
  ChunkResult quick, exact;
  evaluate_chunk(task, quick);
  task.exact = true;
  evaluate_chunk(task, exact);
  EXPECT_NEAR(quick.cost, exact.cost, 1e-12 * exact.cost);
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < exact.A.size(); ++i) {
    largest = std::max(largest, std::abs(exact.A[i]));
    apart = std::max(apart, std::abs(exact.A[i] - quick.A[i]));
  }
  EXPECT_LT(apart, 1e-6 * largest);
  EXPECT_GT(apart, 0.0);
}

// Long steps pass rows, prompt ones and those that a delay shifts; none is lost, and what is predicted there
// is what steps from row to row predict.
TEST(FlightKernel, LongStepsPredictTheRowsWithinThem) {
  Setting s;
  std::vector<double> constants;
  for (const double shift : {0.0, 0.0153}) {
    ChunkTask task = s.task(Eigen::VectorXd::Constant(s.theta.size(), 0.05), constants);
    task.shift = shift;
    task.huber = 1e9, task.exact = true;
    ChunkResult fine, longest, apart;
    evaluate_chunk(task, fine);
    task.steps = Steps::longest;
    evaluate_chunk(task, longest);
    EXPECT_EQ(longest.count, fine.count) << shift;
    EXPECT_NEAR(longest.cost, fine.cost, 1e-4 * fine.cost) << shift;
    const auto d = static_cast<std::size_t>(s.record.layout.size + s.theta.size());
    for (std::size_t i = 0; i < d; ++i)
      EXPECT_NEAR(longest.A[i * d + i], fine.A[i * d + i], 4e-3 * fine.A[i * d + i]) << shift << " " << i;
    task.jacobian = false;
    evaluate_chunk(task, longest);
    task.steps = Steps::fine;
    evaluate_chunk(task, fine);
    double most = 0, differs = 0;
    for (std::size_t i = 0; i < fine.residuals.size(); ++i) {
      if (!std::isfinite(fine.residuals[i])) continue;
      ASSERT_TRUE(std::isfinite(longest.residuals[i])) << i;
      most = std::max(most, std::abs(fine.residuals[i]));
      differs = std::max(differs, std::abs(longest.residuals[i] - fine.residuals[i]));
    }
    EXPECT_LT(differs, 1e-3 * most) << shift;
    EXPECT_GT(differs, 0.0) << "the same steps";
  }
}

TEST(FlightKernel, GradientIsThatOfTheCost) {
  Setting s;
  std::vector<double> constants;
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(s.theta.size(), 0.02);
  ChunkTask task = s.task(u, constants);
  ChunkResult exact, up, down;
  evaluate_chunk(task, exact);
  for (int i = 0; i < s.theta.size(); ++i) {
    Eigen::VectorXd a = u, b = u;
    const double h = 1e-5;
    a[i] += h, b[i] -= h;
    ChunkTask ta = s.task(a, constants);
    evaluate_chunk(ta, up);
    ChunkTask tb = s.task(b, constants);
    evaluate_chunk(tb, down);
    const double numeric = (up.cost - down.cost) / (2 * h),
                 analytic = 2 * exact.g[static_cast<std::size_t>(s.record.layout.size + i)];
    EXPECT_NEAR(analytic, numeric, 1e-4 * std::abs(numeric) + 2e-5) << s.theta.name(i);
  }
}

}  // namespace
}  // namespace ident
