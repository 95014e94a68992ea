// A first-order Markov process, exact for any interval.
#include "ident/sim/turbulence.h"

namespace ident {
namespace {

constexpr double kCorrelationTime = 1.5;  // s

Vec3<double> normal3(Random& random) {
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {x, y, z};
}

}  // namespace

Turbulence::Turbulence(double level, double mass, Random& random)
    : level_(level), mass_(mass), random_(&random) {
  gust_ = level * normal3(random);
  gradient_ = level * normal3(random);
}

void Turbulence::step(double interval) {
  const double keep = std::exp(-interval / kCorrelationTime);
  const double fresh = level_ * std::sqrt(1.0 - keep * keep);
  gust_ = keep * gust_ + fresh * normal3(*random_);
  gradient_ = keep * gradient_ + fresh * normal3(*random_);
}

}  // namespace ident
