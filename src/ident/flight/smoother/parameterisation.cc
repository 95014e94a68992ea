// Coordinates, priors and seeds of the shared unknowns.
#include "ident/flight/smoother/parameterisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ident/core/error.h"
#include "ident/effects/all_parameters.h"
#include "ident/effects/typical_scale.h"

namespace ident {
namespace {

using Eigen::MatrixXd;

// Below this share of its prior value a positive constant is held along its logarithm. Against a weak prior
// it could otherwise vanish for the price of a few standard deviations.
constexpr double kVanishing = 0.1;
// Correlation above which the prior is taken in logarithms: then it matters that a product is known, not a
// sum.
constexpr double kTogether = 0.1;

EffectMask effect_of(int slot) {
  for (const EffectEntry& e : catalogue())
    if (slot >= e.offset && slot < e.offset + static_cast<int>(e.parameters.size())) return mask_of(e.id);
  return 0;
}

// Inverse correlation of the priors of the constants; identity for all other unknowns.
MatrixXd precision_of(const std::vector<FreeConstant>& constants, int size) {
  std::vector<Eigen::Index> at;
  for (std::size_t i = 0; i < constants.size(); ++i)
    if (constants[i].prior_std && !constants[i].known_with.empty())
      at.push_back(static_cast<Eigen::Index>(i));
  const auto n = static_cast<Eigen::Index>(at.size());
  MatrixXd C = MatrixXd::Identity(n, n), precision = MatrixXd::Identity(size, size);
  for (Eigen::Index a = 0; a < n; ++a)
    for (const auto& [index, r] :
         constants[static_cast<std::size_t>(at[static_cast<std::size_t>(a)])].known_with)
      for (Eigen::Index b = 0; b < n; ++b)
        if (constants[static_cast<std::size_t>(at[static_cast<std::size_t>(b)])].index == index)
          C(a, b) = C(b, a) = r;
  if (!C.isIdentity(0)) precision(at, at) = inverse_correlation(C);
  return precision;
}

}  // namespace

Theta::Theta(std::vector<double> p, std::vector<FreeConstant> constants, int logs, bool gyro,
             double gyro_bias_std)
    : p_(std::move(p)),
      constants_(std::move(constants)),
      logs_(logs),
      gyro_(gyro),
      gyro_bias_std_(gyro_bias_std) {
  for (const FreeConstant& c : constants_) p_[static_cast<std::size_t>(c.index)] = c.start;
  for (FreeConstant& c : constants_)
    std::erase_if(c.known_with, [&](const auto& other) {
      return std::ranges::none_of(
          constants_, [&](const FreeConstant& d) { return d.index == other.first && d.prior_std; });
    });
  prior_precision_ = precision_of(constants_, size());
  for (const FreeConstant& c : constants_)
    prior_in_logarithms_.push_back(c.positive && c.times < 0 && c.prior_value > 0 &&
                                   std::ranges::any_of(c.known_with, [](const auto& other) {
                                     return std::abs(other.second) > kTogether;
                                   }));
}

std::string Theta::name(int i) const {
  const int n = constants_count();
  if (i < n) return constants_[static_cast<std::size_t>(i)].name;
  return fmt::format("gyro bias {} of log {}", "xyz"[(i - n) % 3], (i - n) / 3 + 1);
}

double Theta::physical(const Eigen::VectorXd& u, int i) const {
  if (i >= constants_count()) return gyro_bias_std_ * u[i];
  const FreeConstant& c = constants_[static_cast<std::size_t>(i)];
  const double own = c.positive ? c.start * std::exp(u[i]) : c.start + c.scale * u[i];
  const int k = factor(i);
  return k < 0 ? own : own * constants_[static_cast<std::size_t>(k)].start / physical(u, k);
}

double Theta::slope(const Eigen::VectorXd& u, int i) const {
  if (i >= constants_count()) return gyro_bias_std_;
  const FreeConstant& c = constants_[static_cast<std::size_t>(i)];
  const double own = c.positive ? c.start * std::exp(u[i]) : c.scale;
  const int k = factor(i);
  return k < 0 ? own : own * constants_[static_cast<std::size_t>(k)].start / physical(u, k);
}

// The unknown whose product with constant i is estimated; -1 if none.
int Theta::factor(int i) const {
  const int slot = i < constants_count() ? constants_[static_cast<std::size_t>(i)].times : -1;
  if (slot < 0) return -1;
  const auto at = std::ranges::find(constants_, slot, &FreeConstant::index);
  return at == constants_.end() ? -1 : static_cast<int>(at - constants_.begin());
}

// Derivative of the value of constant i with respect to that unknown.
double Theta::slope_over_factor(const Eigen::VectorXd& u, int i) const {
  const int k = factor(i);
  return k < 0 ? 0.0 : -physical(u, i) / physical(u, k) * slope(u, k);
}

Eigen::MatrixXd Theta::slopes(const Eigen::VectorXd& u) const {
  const int n = constants_count();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    J(i, i) = slope(u, i);
    if (const int k = factor(i); k >= 0) J(i, k) = slope_over_factor(u, i);
  }
  return J;
}

double Theta::deviation(const Eigen::VectorXd& u, int i, const Eigen::MatrixXd& covariance) const {
  const double own = slope(u, i), other = slope_over_factor(u, i);
  const int k = std::max(factor(i), 0);
  return std::sqrt(own * own * covariance(i, i) + 2 * own * other * covariance(i, k) +
                   other * other * covariance(k, k));
}

std::vector<double> Theta::p(const Eigen::VectorXd& u) const {
  std::vector<double> p = p_;
  for (int i = 0; i < constants_count(); ++i)
    p[static_cast<std::size_t>(constants_[static_cast<std::size_t>(i)].index)] = physical(u, i);
  return p;
}

std::array<double, 3> Theta::gyro_bias(const Eigen::VectorXd& u, int log) const {
  std::array<double, 3> bias{};
  for (int k = 0; k < 3 && gyro_; ++k)
    bias[static_cast<std::size_t>(k)] = physical(u, constants_count() + 3 * log + k);
  return bias;
}

std::vector<Seed> Theta::seeds(const Eigen::VectorXd& u, int log) const {
  std::vector<Seed> seeds;
  for (int i = 0; i < constants_count(); ++i) {
    const int slot = constants_[static_cast<std::size_t>(i)].index;
    seeds.push_back({slot, i, slope(u, i), effect_of(slot)});
    if (const int k = factor(i); k >= 0) seeds.push_back({slot, k, slope_over_factor(u, i), effect_of(slot)});
  }
  for (int k = 0; k < 3 && gyro_; ++k)
    seeds.push_back({kParameterCount + k, constants_count() + 3 * log + k, gyro_bias_std_, 0});
  return seeds;
}

PriorTerms Theta::prior(const Eigen::VectorXd& u) const {
  PriorTerms terms{Eigen::VectorXd::Zero(size()), Eigen::VectorXd::Zero(size()), prior_precision_};
  for (int i = 0; i < size(); ++i) {
    double std = gyro_bias_std_, value = 0.0, tail = -std::numeric_limits<double>::infinity();
    if (i < constants_count()) {
      const FreeConstant& c = constants_[static_cast<std::size_t>(i)];
      if (!c.prior_std) continue;
      std = *c.prior_std, value = c.prior_value;
      if (prior_in_logarithms_[static_cast<std::size_t>(i)]) {
        terms.residual[i] = std::log(physical(u, i) / value) * value / std;
        terms.slope[i] = value / std;
        continue;
      }
      if (c.positive && factor(i) < 0) tail = kVanishing * value;
    }
    const double at = physical(u, i);
    const bool vanishes = at < tail;
    terms.residual[i] = ((vanishes ? tail + tail * std::log(at / tail) : at) - value) / std;
    terms.slope[i] = (vanishes ? tail : slope(u, i)) / std;
  }
  return terms;
}

Eigen::Matrix3d Theta::inertia(const Eigen::VectorXd& u) const {
  const std::vector<double> p = this->p(u);
  const auto at = [&](int i) { return p[static_cast<std::size_t>(i)]; };
  MassSeam<double> mass{at(param::m), Mat3<double>::Zero(), Vec3<double>::Zero(), at(param::Jp)};
  mass.J << at(param::Jxx), at(param::Jxy), at(param::Jxz), at(param::Jxy), at(param::Jyy), at(param::Jyz),
      at(param::Jxz), at(param::Jyz), at(param::Jzz);
  EffectSet<double>(p, active_effects(p)).apply(mass);
  return mass.J;
}

bool Theta::possible(const Eigen::VectorXd& u) const {
  const Eigen::Matrix3d J = inertia(u);
  const double minor = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
  return J(0, 0) > 0 && minor > 0 &&
         dot(Vec3<double>(J.row(0)), cross(Vec3<double>(J.row(1)), Vec3<double>(J.row(2)))) > 0;
}

double physical_limit(const FreeConstant& constant) {
  const EffectParameter* of = find_effect_parameter(constant.name);
  return of ? of->limit * constant.scale / of->typical : std::numeric_limits<double>::infinity();
}

std::vector<FreeConstant> free_constants(const Vehicle& vehicle, const std::vector<double>& p,
                                         const std::vector<std::string>& also) {
  std::vector<FreeConstant> free;
  const auto add = [&](const ParameterInfo& info) {
    if (std::ranges::find(free, info.name, &FreeConstant::name) != free.end()) return;
    FreeConstant c;
    c.name = info.name;
    c.index = info.index;
    c.start = p[static_cast<std::size_t>(info.index)];
    // Jp too, unless the file has the published signs: without rotor speeds kT km^2, kQ km^2 and Jp km are
    // known, which are straight lines in logarithms only.
    const bool inertia = info.index == param::Jxx || info.index == param::Jyy || info.index == param::Jzz ||
                         (info.index == param::Jp && vehicle.signs != Signs::as_published);
    c.positive = (info.kind == ParameterKind::positive || inertia) && c.start > 0;
    c.scale = typical_scale(info.index, vehicle, p);
    const auto known = vehicle.parameters.find(info.name);
    if (known != vehicle.parameters.end() && known->second.std && *known->second.std > 0) {
      c.prior_std = *known->second.std;
      c.prior_value = known->second.value;
      for (const ParameterInfo& other : all_parameters())
        if (const double r = vehicle.correlation.of(info.name, other.name);
            r != 0 && other.index != info.index)
          c.known_with.emplace_back(other.index, r);
    }
    free.push_back(std::move(c));
  };
  for (const ParameterInfo& info : all_parameters()) {
    const auto known = vehicle.parameters.find(info.name);
    if (known != vehicle.parameters.end() && known->second.std && *known->second.std > 0) add(info);
    const bool always = info.index == param::kT || info.index == param::kQ || info.index == param::km ||
                        info.index == param::omega_m || info.index == param::zeta_m ||
                        info.index == param::Jxx || info.index == param::Jyy || info.index == param::Jzz;
    if (always && !(known != vehicle.parameters.end() && known->second.std && *known->second.std == 0))
      add(info);
  }
  for (const std::string& name : also) {
    const ParameterInfo* info = find_parameter(name);
    if (!info) throw UsageError("there is no parameter '" + name + "'");
    add(*info);
  }
  return free;
}

void know_alone(std::vector<FreeConstant>& constants, int index) {
  for (FreeConstant& c : constants)
    if (c.index == index)
      c.known_with.clear();
    else
      std::erase_if(c.known_with, [&](const auto& other) { return other.first == index; });
}

void leave_out_motors(std::vector<FreeConstant>& constants) {
  std::erase_if(constants, [](const FreeConstant& c) {
    return c.index == param::km || c.index == param::omega_m || c.index == param::zeta_m ||
           c.index == param::dead_time || c.index == param::Omega_0;
  });
}

}  // namespace ident
