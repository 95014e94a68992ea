// A dual number whose derivatives fill SIMD registers: value and K packs of derivatives, forward mode.
//
// The value is a double. Derivatives are of type D: single precision where they serve a Gauss-Newton step,
// which asks for the residuals to the last digit but for their slopes only to some.
//
// `Isa` names an instruction set and the bytes of its vectors, kBytes: wider ones GCC takes apart, and builds
// them again in memory. Code that is compiled several times for different instruction sets names its own one
// in each, so that no function of one build can be taken for that of another.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

namespace ident {

/// `bytes` of numbers.
template <class D, int bytes>
struct VectorOf {
  using type __attribute__((vector_size(bytes))) = D;
};

/// K packs of 64 bytes of derivatives: 8 doubles or 16 floats each.
template <int K, class Isa, class D = double>
struct Dual {
  using Vector = typename VectorOf<D, Isa::kBytes>::type;
  static constexpr int width = K * 64 / static_cast<int>(sizeof(D)),
                       lanes = Isa::kBytes / static_cast<int>(sizeof(D)), vectors = width / lanes;
  double v;
  Vector d[vectors];

  Dual() = default;  // not initialised, like a double: temporaries are many
  Dual(double value)
      : Dual(of(value, [](int) { return Vector{}; })) {}  // NOLINT: a constant is a dual number
  void seed(int i, double derivative = 1.0) { d[i / lanes][i % lanes] = static_cast<D>(derivative); }
  double derivative(int i) const { return static_cast<double>(d[i / lanes][i % lanes]); }

  bool is_constant() const {
    for (int i = 0; i < width; ++i)
      if (derivative(i) != 0) return false;
    return true;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  /// f(a) with derivative `slope`.
  [[gnu::always_inline]] static Dual chain(double f, double slope, const Dual& a) {
    const D s = static_cast<D>(slope);
    return of(f, [&](int k) { return s * a.d[k]; });
  }

  [[gnu::always_inline]] friend Dual operator+(const Dual& a, const Dual& b) {
    return of(a.v + b.v, [&](int k) { return a.d[k] + b.d[k]; });
  }
  [[gnu::always_inline]] friend Dual operator-(const Dual& a, const Dual& b) {
    return of(a.v - b.v, [&](int k) { return a.d[k] - b.d[k]; });
  }
  [[gnu::always_inline]] friend Dual operator*(const Dual& a, const Dual& b) {
    const D x = static_cast<D>(a.v), y = static_cast<D>(b.v);
    return of(a.v * b.v, [&](int k) { return x * b.d[k] + y * a.d[k]; });
  }
  [[gnu::always_inline]] friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.v, quotient = a.v * inverse;
    const D x = static_cast<D>(quotient), y = static_cast<D>(inverse);
    return of(quotient, [&](int k) { return (a.d[k] - x * b.d[k]) * y; });
  }
  [[gnu::always_inline]] friend Dual operator-(const Dual& a) { return chain(-a.v, -1.0, a); }
  [[gnu::always_inline]] friend Dual operator+(const Dual& a, double b) { return shifted(a, b); }
  [[gnu::always_inline]] friend Dual operator+(double a, const Dual& b) { return shifted(b, a); }
  [[gnu::always_inline]] friend Dual operator-(const Dual& a, double b) { return shifted(a, -b); }
  [[gnu::always_inline]] friend Dual operator-(double a, const Dual& b) { return chain(a - b.v, -1.0, b); }
  [[gnu::always_inline]] friend Dual operator*(const Dual& a, double b) { return chain(a.v * b, b, a); }
  [[gnu::always_inline]] friend Dual operator*(double a, const Dual& b) { return chain(a * b.v, a, b); }
  [[gnu::always_inline]] friend Dual operator/(const Dual& a, double b) { return chain(a.v / b, 1.0 / b, a); }
  [[gnu::always_inline]] friend Dual operator/(double a, const Dual& b) {
    return chain(a / b.v, -a / (b.v * b.v), b);
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }

  /// a + h b for a constant h: one pass over the derivatives.
  [[gnu::always_inline]] friend Dual sum(const Dual& a, double h, const Dual& b) {
    const D s = static_cast<D>(h);
    return of(a.v + h * b.v, [&](int k) { return a.d[k] + s * b.d[k]; });
  }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.v);
    return chain(root, 0.5 / root, a);
  }
  friend Dual exp(const Dual& a) {
    const double e = std::exp(a.v);
    return chain(e, e, a);
  }
  friend Dual log(const Dual& a) { return chain(std::log(a.v), 1.0 / a.v, a); }
  friend Dual sin(const Dual& a) { return chain(std::sin(a.v), std::cos(a.v), a); }
  friend Dual cos(const Dual& a) { return chain(std::cos(a.v), -std::sin(a.v), a); }

 private:
  // Unrolled by order: else GCC keeps the vectors in memory at -O2.
  template <class Of>
  [[gnu::always_inline]] static Dual of(double value, Of of_vector) {
    Dual r;
    r.v = value;
#pragma GCC unroll 16
    for (int k = 0; k < vectors; ++k) r.d[k] = of_vector(k);
    return r;
  }
  [[gnu::always_inline]] static Dual shifted(const Dual& a, double b) {
    Dual r = a;
    r.v += b;
    return r;
  }
};

}  // namespace ident

namespace Eigen {
template <int K, class Isa, class D>
struct NumTraits<ident::Dual<K, Isa, D>> : GenericNumTraits<ident::Dual<K, Isa, D>> {
  using Real = ident::Dual<K, Isa, D>;
  using NonInteger = Real;
  using Nested = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 4,
    MulCost = 8
  };
};
}  // namespace Eigen
