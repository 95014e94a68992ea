// Which of two predictions of the same windows is better, beyond chance.
#pragma once

#include <vector>

namespace field {

struct Comparison {
  double first = 0, second = 0;  // root mean squares
  double low = 0, high = 0;      // 95 % interval of mean(second^2 - first^2)
  bool second_better() const { return high < 0; }
  bool second_worse() const { return low > 0; }
};

// Squared errors of both; blocks of `block` neighbouring windows are drawn with replacement.
Comparison compare(const std::vector<double>& first, const std::vector<double>& second, int block,
                   int draws = 1000);

}  // namespace field
