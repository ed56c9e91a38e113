// A number that carries its derivatives: a value and n tangents, which follow it through all operations (Wengert 1964,
// Comm. ACM 7, 463). What is decided is decided by the values alone, so that they have the bits of the plain run.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "pendula/scalar/product.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

// The tangents of one number, of a scalar that there are no packs of.
template <class S, int n>
struct bundle {
  std::array<S, n> each;

  bundle() = default;
  explicit bundle(const S& x) { each.fill(x); }
  const S& operator[](int i) const { return each[static_cast<std::size_t>(i)]; }
  void set(int i, const S& x) { each[static_cast<std::size_t>(i)] = x; }

  friend bundle operator-(const bundle& a) {
    return a.with(a, [](const S& x, const S&) { return S(-x); });
  }
  friend bundle operator+(const bundle& a, const bundle& b) { return a.with(b, std::plus<S>()); }
  friend bundle operator-(const bundle& a, const bundle& b) { return a.with(b, std::minus<S>()); }
  friend bundle operator*(const bundle& a, const bundle& b) { return a.with(b, std::multiplies<S>()); }
  friend bundle operator/(const bundle& a, const bundle& b) { return a.with(b, std::divides<S>()); }

 private:
  template <class Operation>
  bundle with(const bundle& b, Operation&& operation) const {
    bundle result;
    std::ranges::transform(each, b.each, result.each.begin(), operation);
    return result;
  }
};

template <class S, int n>
struct tangents_of {
  using type = bundle<S, n>;
};
template <int n>
struct tangents_of<double, n> {
  using type = pack<double, n>;
};

template <int n, class S = double>
struct dual {
  using tangents = typename tangents_of<S, n>::type;

  S value;
  tangents change;

  dual() = default;
  PENDULA_INLINE dual(const S& x) : value(x), change(S(0.0)) {}
  PENDULA_INLINE dual(const S& x, const tangents& d) : value(x), change(d) {}

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
    const S quotient = a.value / b.value;
    return {quotient, (a.change - b.change * tangents(quotient)) / tangents(b.value)};
  }
  PENDULA_INLINE friend bool equal(const dual& a, const dual& b) { return a.value == b.value; }
  PENDULA_INLINE friend bool less(const dual& a, const dual& b) { return a.value < b.value; }
  PENDULA_INLINE friend dual choose(bool condition, const dual& yes, const dual& no) { return condition ? yes : no; }
  PENDULA_INLINE friend dual magnitude(const dual& a) { return std::signbit(a.value) ? -a : a; }
  PENDULA_INLINE friend dual nearest_whole(const dual& a) { return dual(pendula::nearest_whole(a.value)); }
  PENDULA_INLINE friend double lane(const dual& a, int) { return a.value; }
};

// The product's change is all that of the product: none is left for its rounding error, whichever way that is found.
template <int n>
PENDULA_INLINE head_and_tail<dual<n>> two_product(const dual<n>& a, const dual<n>& b) {
  return {a * b, dual<n>(two_product(a.value, b.value).tail)};
}

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
