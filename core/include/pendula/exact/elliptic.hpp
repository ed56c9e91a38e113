// Elliptic integrals and Jacobi elliptic functions of real arguments, to the last bits, over lanes. The modulus is
// given as k, also above 1, or as its complement kc = √(1 − k²).
#pragma once

#include <numbers>

#include "pendula/exact/many_digits.hpp"
#include "pendula/exact/theta.hpp"
#include "pendula/scalar/arctangent.hpp"

namespace pendula::inline PENDULA_MACHINE {

// K, E, B, am and dn lie within so many units in the last place of the right value; sn and cn, and for k > 1, where am
// and dn have zeros, all four, within so many 2^-52 max(|value|, jacobi_floor). Where kc is below 1e-300 dn may have no
// digits.
inline constexpr double complete_ulps = 1.0, jacobi_ulps = 3.0, jacobi_epsilons = 3.0, jacobi_floor = 1e-3;
inline constexpr double largest_jacobi_count = 0x1p200;  // half periods, beyond which the functions are NaN
inline constexpr double reach_of_wide_rate = 0x1p34;     // arguments beyond take a rate of more digits
inline constexpr double tiny_argument = 0x1p-30;         // below, sin φ, φ, u and sn u are the same to 2^-61

// For k > 1 the functions are those of the modulus 1/k, of an argument stretched by k (DLMF 22.17.2–4).
template <class S>
struct modulus {
  using mask = decltype(less(S(0.0), S(0.0)));

  wide<S> k, kc;    // each with its own last bits; for k > 1 those of 1/k
  wide<S> stretch;  // 1, or k where it is above 1
  S given;
  bool given_complement;

  // √((1 − k)(1 + k)), which loses nothing where 1 − k cancels.
  PENDULA_INLINE static wide<S> complement(S x) {
    const auto above = less(S(1.0), x);
    wide<S> below(two_sum(S(1.0), -x)), beyond(two_sum(S(1.0), x));
    below = scaled(below, choose(above, S(-1.0), S(1.0)));
    if (any_lane(above)) {
      below = choose(above, below / wide<S>(x, S(0.0)), below);
      beyond = choose(above, beyond / wide<S>(x, S(0.0)), beyond);
    }
    const auto zero = equal(below.hi, S(0.0));
    return choose(zero, wide<S>(0.0), square_root(choose(zero, wide<S>(1.0), below * beyond)));
  }
  PENDULA_INLINE static modulus from_k(S k) {
    modulus m{{k, S(0.0)}, complement(k), wide<S>(1.0), k, false};
    const auto above = less(S(1.0), k);
    if (any_lane(above)) {
      m.stretch = choose(above, m.k, m.stretch);
      m.k = choose(above, wide<S>(1.0) / m.k, m.k);
    }
    return m;
  }
  PENDULA_INLINE static modulus from_kc(S kc) { return {complement(kc), {kc, S(0.0)}, wide<S>(1.0), kc, true}; }
};

// The means a_n, b_n and c_n = (a_{n−1} − b_{n−1})/2 from 1, kc, k (DLMF 19.8.1–3): their limit, and Σ 2^(n−1) c_n²
// from n = 1 on. Each lane stops for itself.
template <class S>
struct mean_and_sum {
  wide<S> mean, sum;

  PENDULA_INLINE explicit mean_and_sum(const modulus<S>& m) {
    const wide<S> kc = choose(equal(m.kc.hi, S(0.0)), wide<S>(1.0), m.kc);
    wide<S> a = scaled(sum_with_smaller(wide<S>(1.0), kc), S(0.5));
    wide<S> b = scaled(square_root(scaled(kc, S(0x1p600))), S(0x1p-300));  // its tail must not underflow
    wide<S> c = square(m.k) / scaled(a, S(4.0));                           // (1 − kc)/2
    sum = square(c);
    S weight(1.0);
    for (auto apart = far(a, c); any_lane(apart); apart = mask_and(apart, far(a, c))) {
      const wide<S> half_sum = scaled(sum_with_smaller(a, b), S(0.5)), root = square_root(a * b);
      const wide<S> half_difference = scaled(settled(sum_with_smaller(a, -b)), S(0.5));
      weight = weight + weight;
      a = choose(apart, half_sum, a);
      b = choose(apart, root, b);
      c = choose(apart, half_difference, c);
      sum = choose(apart, quick_sum(sum, scaled(square(half_difference), weight)), sum);
    }
    mean = sum_with_smaller(a, S(-0.25) * c.hi * c.hi / a.hi);  // c_{n+1} = c_n²/4a_{n+1}; the next is below 2^-160
  }

 private:
  PENDULA_INLINE static auto far(wide<S> a, wide<S> c) { return less(a.hi * S(0x1p-40), c.hi); }
};

namespace detail {
template <class S>
PENDULA_INLINE wide<S> quarter_period(wide<S> mean) {  // DLMF 19.8.5
  return scaled(wide_pi<S>::value(), S(0.5)) / mean;
}
// The value at k = 1, where there is no mean; none for k > 1.
template <class S>
PENDULA_INLINE S up_to_one(const modulus<S>& m, S value, double at_one) {
  const S none(std::numeric_limits<double>::quiet_NaN());
  return choose(equal(m.kc.hi, S(0.0)), S(at_one), choose(less(S(1.0), m.stretch.hi), none, value));
}
}  // namespace detail

// For k ≤ 1, as the next two; they are complex beyond.
template <class S>
PENDULA_INLINE S complete_K(const modulus<S>& m) {
  return detail::up_to_one(m, rounded(detail::quarter_period(mean_and_sum<S>(m).mean)), INFINITY);
}

// E = K (1 − k²/2 − Σ 2^(n−1) c_n²), DLMF 19.8.6. Of the difference at least 1/K is left, and it is wide.
template <class S>
PENDULA_INLINE S complete_E(const modulus<S>& m) {
  const mean_and_sum<S> of(m);
  const wide<S> without = sum_with_smaller(wide<S>(1.0), -scaled(square(m.k), S(0.5)));
  const wide<S> part = settled(quick_sum(without, -of.sum));
  return detail::up_to_one(m, rounded(detail::quarter_period(of.mean) * part), 1.0);
}

// B = (E − kc² K)/k² = K (1/2 − Σ/k²), without cancellation for small k: Jahnke & Emde (1945); DLMF 19.8.6.
template <class S>
PENDULA_INLINE S complete_B(const modulus<S>& m) {
  const mean_and_sum<S> of(m);
  const wide<S> k2 = square(m.k);
  const auto small = less(k2.hi, S(0x1p-120));
  const wide<S> ratio = choose(small, wide<S>(0.0), of.sum / choose(small, wide<S>(1.0), k2));
  const wide<S> part = settled(sum_with_smaller(wide<S>(0.5), -ratio));
  return detail::up_to_one(m, rounded(detail::quarter_period(of.mean) * part), 1.0);
}

// The first terms of K = (π/2) Σ [(2n)!/(2^{2n}(n!)²)]² k^{2n}, each from the one before: Herrera et al. (2024),
// eq. 26; DLMF 19.5.1.
inline double complete_elliptic_K_series(double k, long terms) {
  double term = 1.0, sum = 0.0;
  for (long n = 1; n <= terms; ++n) {
    const double before = sum;
    sum += term;
    const double factor = (2.0 * static_cast<double>(n) - 1.0) / (2.0 * static_cast<double>(n)) * k;
    term *= factor * factor;
    if (sum == before) break;  // the rest is below the last bit
  }
  return 0.5 * std::numbers::pi * sum;
}

struct modulus_in_many_digits {
  many_digits kc, stretch;
};
inline modulus_in_many_digits in_many_digits(double given, bool given_complement) {
  const many_digits x = given, above = given > 1.0 ? x : many_digits(1);
  if (given_complement) return {x, above};
  return {sqrt(abs(many_digits((1 - x) * (1 + x)))) / above, above};
}

template <class S>
struct jacobi_values {
  S am, sn, cn, dn;
};

// For one modulus, any number of arguments.
template <class S>
class jacobi_functions {
 public:
  using mask = typename modulus<S>::mask;

  PENDULA_INLINE explicit jacobi_functions(const modulus<S>& m)
      : m_(m),
        theta_(m.kc),
        rate_(theta_.mean * wide_pi<S>::inverse() * m.stretch),
        beyond_one_(less(S(1.0), m.stretch.hi)),
        one_(equal(m.kc.hi, S(0.0))) {}

  PENDULA_INLINE jacobi_values<S> operator()(S u) const {
    const auto [whole, parity, rest] = phase(u);
    jacobi_quartet<S> v = theta_(rest);
    if (any_lane(one_)) v = chosen(one_, hyperbolic(u), v);
    const S sign = choose(beyond_one_, S(1.0), parity);
    const S turns = choose(mask_and(mask_not(one_), mask_not(beyond_one_)), whole, S(0.0)), inverse = S(1.0) / v.w.hi;
    wide<S> s = v.s, c = v.c, d = v.d;
    if (any_lane(beyond_one_)) {  // sn(u, k) = sn(ku, 1/k)/k, cn(u, k) = dn(ku, 1/k), dn(u, k) = cn(ku, 1/k)
      s = choose(beyond_one_, scaled(s / m_.stretch, parity), s);
      c = choose(beyond_one_, v.d, c);
      d = choose(beyond_one_, scaled(v.c, parity), d);
    }
    const wide<S> turned = wide_pi<S>::value() * turns;
    const jacobi_values<S> values{turned.hi + (turned.lo + angle_of(rounded(s), rounded(c))),
                                  rounded(quotient(scaled(s, sign), v.w, inverse)),
                                  rounded(quotient(scaled(c, sign), v.w, inverse)), rounded(quotient(d, v.w, inverse))};
    return at_the_ends(u, whole, values);
  }

 private:
  struct counted {
    S whole, parity;
    wide<S> rest;
  };

  // Half periods in u, the nearest whole number and the rest, which keeps its digits where it is small.
  PENDULA_INLINE counted phase(S u) const {
    const auto [product, product_tail] = two_product(u, rate_.hi);
    const S whole = nearest_whole(product);
    const auto [rest, rest_tail] = two_sum(product - whole, product_tail);
    counted result{whole, parity_sign(whole), wide<S>(two_sum(rest, rest_tail + u * rate_.lo))};
    const S stretched = magnitude(u) * m_.stretch.hi;
    if (any_lane(mask_and(less(S(reach_of_wide_rate), stretched), mask_not(one_)))) count_again(u, stretched, result);
    result.parity = choose(one_, S(1.0), result.parity);
    return result;
  }

  [[gnu::noinline]] void count_again(S u, S stretched, counted& result) const {
    for (int l = 0; l < lanes<S>::count; ++l) {
      const bool of_use = std::fabs(lane(u, l) * lane(rate_.hi, l)) <= largest_jacobi_count && !lane_of(one_, l);
      if (!of_use || lane(stretched, l) <= reach_of_wide_rate) continue;
      const auto [kc, stretch] = in_many_digits(lane(m_.given, l), m_.given_complement);
      const auto [whole, parity, rest] = nearest_count(half_periods_in_many_digits(kc, stretch) * lane(u, l));
      set_lane(result.whole, l, whole);
      set_lane(result.parity, l, parity);
      set_lane(result.rest.hi, l, rest.hi);
      set_lane(result.rest.lo, l, rest.lo);
    }
  }

  // At k = 1: tanh u and sech u (DLMF 22.5.4) by e^−|u|, in two halves because it ends below the normal numbers.
  PENDULA_INLINE static jacobi_quartet<S> hyperbolic(S u) {
    const S size = magnitude(u);
    const wide<S> twice = scaled(square(exponential(wide<S>(S(-0.5) * size, S(0.0))).value), S(2.0));
    const wide<S> less_one = exponential(wide<S>(S(-2.0) * size, S(0.0))).minus_one;
    return {scaled(-less_one, times_sign_of(S(1.0), u)), twice, twice, sum_with_smaller(wide<S>(2.0), less_one)};
  }

  PENDULA_INLINE static jacobi_quartet<S> chosen(mask so, const jacobi_quartet<S>& yes, const jacobi_quartet<S>& no) {
    return {choose(so, yes.s, no.s), choose(so, yes.c, no.c), choose(so, yes.d, no.d), choose(so, yes.w, no.w)};
  }

  PENDULA_INLINE jacobi_values<S> at_the_ends(S u, S whole, jacobi_values<S> v) const {
    const S size = magnitude(u), nan(std::numeric_limits<double>::quiet_NaN());
    const auto tiny = mask_and(less(size * m_.stretch.hi, S(tiny_argument)), equal(m_.kc.hi, m_.kc.hi));
    const auto counted = less(magnitude(whole), S(largest_jacobi_count));  // and NaN is not
    const auto lost = mask_and(mask_not(counted), mask_not(mask_and(one_, equal(u, u))));
    return {choose(tiny, u, choose(lost, nan, v.am)), choose(tiny, u, choose(lost, nan, v.sn)),
            choose(tiny, S(1.0), choose(lost, nan, v.cn)), choose(tiny, S(1.0), choose(lost, nan, v.dn))};
  }

  modulus<S> m_;
  jacobi_theta<S> theta_;
  wide<S> rate_;
  mask beyond_one_, one_;
};

}  // namespace pendula::inline PENDULA_MACHINE
