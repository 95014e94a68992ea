// Fixed and random effects over files.
//
//   equal files:    y = sum w_i y_i/sum w_i ,  w_i = 1/s_i^2 ,  Q = sum w_i (y_i - y)^2 ~ chi^2(F - 1) (1)
//   unequal files:  w_i = 1/(s_i^2 + tau^2) ,  tau^2 by DerSimonian and Laird ,
//                   std^2 = sum w_i (y_i - y)^2/((F - 1) sum w_i) ,  t with F - 1  [Knapp, Hartung] (2)
#include "ident/bench/thrust/thrust_sweep_pool.h"

#include <algorithm>
#include <cmath>

#include "ident/core/math.h"
#include "ident/core/statistics.h"

namespace ident {
namespace {

constexpr double kDiffer = 0.01;

struct Weighted {
  double mean = 0.0, weight = 0.0, spread = 0.0;
};
Weighted weighted(const std::vector<double>& y, const std::vector<double>& w) {
  Weighted sum;
  for (std::size_t i = 0; i < y.size(); ++i) sum.mean += w[i] * y[i], sum.weight += w[i];
  sum.mean /= sum.weight;
  for (std::size_t i = 0; i < y.size(); ++i) sum.spread += w[i] * square(y[i] - sum.mean);
  return sum;
}

}  // namespace

PooledEstimate pool(const std::vector<FileEstimate>& all) {
  std::vector<FileEstimate> files;
  std::ranges::copy_if(all, std::back_inserter(files), [](const FileEstimate& f) {
    return f.value > 0.0 && f.std > 0.0 && std::isfinite(f.std);
  });
  if (files.empty()) return {};
  if (files.size() == 1) return {files[0].value, files[0].std, files[0].dof};
  std::vector<double> y, w;
  for (const FileEstimate& f : files) y.push_back(std::log(f.value)), w.push_back(square(f.value / f.std));
  const double more = static_cast<double>(files.size() - 1);
  const Weighted equal = weighted(y, w);
  double dof_inverse = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < w.size(); ++i) {
    dof_inverse += square(w[i] / equal.weight) / files[i].dof;
    squares += w[i] * w[i];
  }
  PooledEstimate found{.p_equal = 1.0 - f_cdf(equal.spread / more, more, 1.0 / dof_inverse)};
  found.files_differ = found.p_equal < kDiffer;
  if (!found.files_differ) {
    found.value = std::exp(equal.mean);
    found.std = found.value / std::sqrt(equal.weight);  // (1)
    found.dof = 1.0 / dof_inverse;
    return found;
  }
  const double tau2 = std::max(0.0, (equal.spread - more) / (equal.weight - squares / equal.weight));
  for (double& weight : w) weight = 1.0 / (1.0 / weight + tau2);
  const Weighted unequal = weighted(y, w);
  found.value = std::exp(unequal.mean);
  found.std = found.value * std::sqrt(unequal.spread / (more * unequal.weight));  // (2)
  found.dof = more;
  found.scatter = std::sqrt(tau2);
  return found;
}

Parameter pooled_parameter(std::string name, const PooledEstimate& pooled, std::string unit,
                           std::string source) {
  const double half = t95(pooled.dof) * pooled.std / pooled.value;
  return {.name = std::move(name),
          .value = pooled.value,
          .std = pooled.std,
          .ci95 = {pooled.value * std::exp(-half), pooled.value * std::exp(half)},
          .unit = std::move(unit),
          .identifiable = pooled.std < 0.1 * pooled.value,
          .source = std::move(source)};
}

}  // namespace ident
