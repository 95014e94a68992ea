// An axis of a plot: its range, its ticks at round numbers, and where a value stands on the paper.
#pragma once

#include <string>
#include <vector>

namespace ident {

/// The extent of data; grows by what it is shown. Values that are not finite are passed over.
struct Extent {
  double low, high;
  Extent();
  void add(double value);
  bool empty() const { return low > high; }
};

/// By how much of its length an axis goes on beyond the data.
struct Padding {
  double low = 0, high = 0;
};

struct Tick {
  double value;
  std::string label;
};

/// Linear or logarithmic; a common power of ten is taken out of the labels into `factor`, as "×10⁻⁶".
class Scale {
 public:
  /// Ticks at 1, 2 or 5 times a power of ten, about `wanted` of them.
  static Scale linear(Extent extent, int wanted, Padding padding);
  /// Ticks at powers of ten; `extent` holds positive values only.
  static Scale logarithmic(Extent extent);
  /// 0 .. count-1 with half a step on either side, labelled by the names.
  static Scale categories(const std::vector<std::string>& names);

  /// 0 at the low end, 1 at the high end; NaN for what a logarithmic scale cannot show.
  double position(double value) const;
  double low() const { return low_; }
  double high() const { return high_; }
  const std::vector<Tick>& ticks() const { return ticks_; }
  const std::string& factor() const { return factor_; }
  bool has_grid() const { return grid_; }

 private:
  double low_ = 0, high_ = 1;
  bool log_ = false, grid_ = true;
  std::vector<Tick> ticks_;
  std::string factor_;
};

/// 10 to `power` in superscript digits: "10⁻⁶".
std::string power_of_ten(int power);

}  // namespace ident
