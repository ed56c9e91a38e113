// Complex numbers of wide parts, as far as modes of linear motions need them.
#pragma once

#include "pendula/scalar/sincos_of_half_turns.hpp"
#include "pendula/scalar/wide_sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

struct wide_complex {
  wide<double> re, im;

  friend wide_complex operator+(wide_complex a, wide_complex b) { return {a.re + b.re, a.im + b.im}; }
  friend wide_complex operator+(wide_complex a, wide<double> b) { return {a.re + b, a.im}; }
  friend wide_complex operator*(wide_complex a, wide<double> b) { return {a.re * b, a.im * b}; }
  friend wide_complex operator*(wide_complex a, wide_complex b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
};

// Re(a b)
inline wide<double> real_product(wide_complex a, wide_complex b) { return a.re * b.re - a.im * b.im; }

// e^{iπrt}, where r is given as three numbers (`three_words` of exact/many_digits.hpp) and |r t| is below 2^50: of the
// phase nothing is left out above 2^-156 of all of it.
inline wide_complex direction_after(const double (&rate)[3], wide<double> t) {
  const auto [product, product_tail] = two_product(t.hi, rate[0]);
  const auto [second, second_tail] = two_product(t.hi, rate[1]);
  const auto [third, third_tail] = two_product(t.lo, rate[0]);
  const double small = (second_tail + third_tail) + (t.hi * rate[2] + t.lo * rate[1]);
  const double whole = nearest_whole(product), sign = parity_sign(whole);
  const wide<double> near(two_sum(product - whole, product_tail)), below(two_sum(second, third));
  const wide<double> x = wide_pi<double>::value() * (near + (below + wide<double>(small)));
  const auto [sine, cosine] = wide_sincos(x.hi);
  return {scaled(sum_with_smaller(cosine, -(sine * x.lo)), sign), scaled(sum_with_smaller(sine, cosine * x.lo), sign)};
}

}  // namespace pendula::inline PENDULA_MACHINE
