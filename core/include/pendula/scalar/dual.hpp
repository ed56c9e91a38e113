// A number that carries its derivatives: a value and n tangents, which follow it through all operations (Wengert 1964,
// Comm. ACM 7, 463). What is decided is decided by the values alone, so that they have the bits of the plain run.
#pragma once

#include <cmath>

#include "pendula/scalar/product.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <int n>
struct dual {
  using tangents = pack<double, n>;

  double value;
  tangents change;

  dual() = default;
  PENDULA_INLINE dual(double x) : value(x), change(0.0) {}
  PENDULA_INLINE dual(double x, tangents d) : value(x), change(d) {}

  bool changes() const { return any_lane(mask_not(equal(change, tangents(0.0)))); }

  PENDULA_INLINE friend dual operator-(const dual& a) { return {-a.value, -a.change}; }
  PENDULA_INLINE friend dual operator+(const dual& a, const dual& b) {
    return {a.value + b.value, a.change + b.change};
  }
  PENDULA_INLINE friend dual operator-(const dual& a, const dual& b) {
    return {a.value - b.value, a.change - b.change};
  }
  PENDULA_INLINE friend dual operator*(const dual& a, const dual& b) {
    return {a.value * b.value, a.change * tangents(b.value) + b.change * tangents(a.value)};
  }
  PENDULA_INLINE friend dual operator/(const dual& a, const dual& b) {
    const double quotient = a.value / b.value;
    return {quotient, (a.change - b.change * tangents(quotient)) / tangents(b.value)};
  }
  PENDULA_INLINE friend bool equal(const dual& a, const dual& b) { return a.value == b.value; }
  PENDULA_INLINE friend bool less(const dual& a, const dual& b) { return a.value < b.value; }
  PENDULA_INLINE friend dual choose(bool condition, const dual& yes, const dual& no) { return condition ? yes : no; }
  PENDULA_INLINE friend dual magnitude(const dual& a) { return std::signbit(a.value) ? -a : a; }
  PENDULA_INLINE friend dual nearest_whole(const dual& a) { return dual(pendula::nearest_whole(a.value)); }
  PENDULA_INLINE friend double lane(const dual& a, int) { return a.value; }
  // a b − p, of which the value is the rounding error of a product.
  PENDULA_INLINE friend dual product_minus(const dual& a, const dual& b, const dual& p) {
    if constexpr (fused_multiply_add) {
      return {pendula::product_minus(a.value, b.value, p.value),
              (a.change * tangents(b.value) + b.change * tangents(a.value)) - p.change};
    } else {
      return p;  // is not asked for
    }
  }
};

template <int n>
inline constexpr bool has_double_precision<dual<n>> = true;
template <int n>
inline constexpr bool carries_rounding<dual<n>> = true;

template <int n>
struct elementary<dual<n>> {
  using S = dual<n>;
  using tangents = typename S::tangents;

  static sine_cosine<S> sincos(const S& x) {
    const auto [s, c] = pendula::sincos(x.value);
    return {S(s, x.change * tangents(c)), S(c, x.change * tangents(-s))};
  }
  static double rough(const S& x) { return x.value; }
  static double rough_log2(const S& x) { return pendula::rough_log2(x.value); }
};

}  // namespace pendula::inline PENDULA_MACHINE
