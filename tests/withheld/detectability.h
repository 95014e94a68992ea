// The generator's own Fisher information: what size of effect a flight could show at all.
#pragma once

#include <string>
#include <vector>

#include "sensitivities.h"

namespace withheld {

// Scalar products of whitened signatures, summed over logs. Column order is the caller's.
class Gram {
 public:
  explicit Gram(Eigen::Index columns) : G_(Eigen::MatrixXd::Zero(columns, columns)) {}

  // One log: a signature (difference of predicted readings) for each column.
  void add(const std::vector<Channels>& signatures, const Vehicle& vehicle, const Effects& effects,
           const Instruments& instruments, const GustSettings& gusts, double rate);
  // A value known beforehand: its column is in units of its standard deviation.
  void add_prior(Eigen::Index column) { G_(column, column) += 1; }

  // Squared length of a signature (noncentrality) after the best fit of the nuisances.
  Eigen::Index columns() const { return G_.cols(); }

  double left(Eigen::Index signature, const std::vector<Eigen::Index>& nuisances) const;

 private:
  Eigen::MatrixXd G_;
};

// Noncentrality that is found with 90 % power at 1 % family-wise false alarm over the catalogue's 21 effects.
double required_noncentrality(int freedom);

}  // namespace withheld
