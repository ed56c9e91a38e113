// The Jacobi elliptic functions by theta functions: sn, cn and dn as quotients, DLMF 22.2.4–6, for one modulus. Far
// from modulus 1 the nome q is small and the series in v = πu/2K (DLMF 20.2) end after five terms; near it the
// imaginary transformation (DLMF 22.6(iv)) makes them series in hyperbolic functions whose nome q' is small.
#pragma once

#include <numbers>

#include "pendula/scalar/exponential.hpp"
#include "pendula/scalar/sincos_of_half_turns.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr double near_one = 0.3;  // complementary moduli below take the series in q': q < 0.147, q' < 0.006

// sn = s/w, cn = c/w, dn = d/w.
template <class S>
struct jacobi_quartet {
  wide<S> s, c, d, w;
};

// The arithmetic–geometric mean of 1 and kc (DLMF 19.8(i)) to about 2^-100. The last steps are one series in
// x = (a − b)/(a + b): AGM(1 + x, 1 − x) = π/(2K(x)) by DLMF 19.8.5 and 19.5.1. Each lane stops for itself.
template <class S>
struct arithmetic_geometric_mean {
  wide<S> value, root;  // and √kc, which the first step makes

  // Takes 1/(2 kc), too.
  PENDULA_INLINE arithmetic_geometric_mean(wide<S> kc, S half_inverse) : root(square_root_by(kc, half_inverse).root) {
    if (any_lane(less(kc.hi, S(0x1p-900))))  // whose error terms would underflow
      root = scaled(square_root(scaled(kc, S(0x1p600))), S(0x1p-300));
    wide<S> a = scaled(sum_with_smaller(wide<S>(1.0), kc), S(0.5)), b = root;
    for (auto apart = far(a, b); any_lane(apart); apart = far(a, b)) {
      const wide<S> mean = scaled(sum_with_smaller(a, b), S(0.5)), geometric = square_root(a * b);
      a = choose(apart, mean, a);
      b = choose(apart, geometric, b);
    }
    const wide<S> mean = scaled(sum_with_smaller(a, b), S(0.5));
    const wide<S> half = scaled(settled(sum_with_smaller(a, -b)), S(0.5));
    const S inverse = S(1.0) / mean.hi;
    const wide<S> x = quotient(half, mean, inverse), x2 = square(x);
    const S x6 = x2.hi * x2.hi * x2.hi,
            higher = x6 * (S(11.0 / 256.0) + x2.hi * (S(469.0 / 16384.0) + x2.hi * S(1379.0 / 65536.0)));
    const wide<S> lower = sum_with_smaller(scaled(x2, S(0.25)), square(x2) * S(5.0 / 64.0));
    value = sum_with_smaller(mean, -(mean * sum_with_smaller(lower, higher)));
  }

 private:
  PENDULA_INLINE static auto far(wide<S> a, wide<S> b) { return less(b.hi, a.hi * S(1.0 - 0x1p-8)); }
};

// For moduli far from 1. Of θ1 and θ2 what is left of them over 2 q^¼ sin v or cos v is one polynomial, in sin² v or
// cos² v; so it is for θ4 and θ3 (DLMF 20.2.1–4 and the multiples of v). No term cancels another.
template <class S>
class nome_series {
 public:
  // From √kc: the nome by DLMF 19.5.6–7 with the terms of OEIS A002103.
  PENDULA_INLINE explicit nome_series(wide<S> root) {
    const wide<S> one(1.0);
    const S e = S(0.5) * ((S(1.0) - root.hi) - root.lo) / (S(1.0) + root.hi), e2 = e * e, e4 = e2 * e2;
    const S more =
        e4 * (S(2.0) +
              e4 * (S(15.0) +
                    e4 * (S(150.0) + e4 * (S(1707.0) + e4 * (S(20910.0) + e4 * (S(268616.0) + e4 * S(3567400.0)))))));
    const S q1 = e + e * more, q2 = q1 * q1, q4 = q2 * q2, q6 = q4 * q2, q9 = q6 * q2 * q1, q12 = q6 * q6,
            q16 = q12 * q4;
    one_ = sum_with_smaller(one, S(-3.0) * q2 + (S(5.0) * q6 + (S(-7.0) * q12 + S(9.0) * (q16 * q4))));
    one1_ = S(4.0) * q2 + (S(-20.0) * q6 + S(56.0) * q12);
    one2_ = S(16.0) * q6 - S(112.0) * q12;
    one3_ = S(64.0) * q12;
    const S four_rest = S(2.0) * q4 - (S(2.0) * q9 - S(2.0) * q16);
    four_ = sum_with_smaller(one, S(-2.0) * q1 + four_rest);
    four1_ = S(4.0) * q1 + (S(-16.0) * q4 + (S(36.0) * q9 - S(64.0) * q16));
    four2_ = S(16.0) * q4 + (S(-96.0) * q9 + S(320.0) * q16);
    four3_ = S(64.0) * q9 - S(512.0) * q16;
    four4_ = S(256.0) * q16;
    // θ3(0)/θ2(0), θ4(0)/θ2(0) and θ4(0)/θ3(0) = √kc (DLMF 22.2.2), all times θ2(0)
    const S three_rest = S(2.0) * q4 + (S(2.0) * q9 + S(2.0) * q16);
    of_w_ = sum_with_smaller(one, q2 + (q6 + q12));
    of_s_ = sum_with_smaller(one, S(2.0) * q1 + three_rest);
    of_c_ = four_;
    of_d_ = root * of_w_;
  }

  // At u = 2 K r, |r| ≤ 1/2.
  PENDULA_INLINE jacobi_quartet<S> operator()(wide<S> r) const {
    const auto [s, c] = sincos_of_half_turns(r);
    const S s2 = s * s, c2 = c * c;
    return {theta_one(s2) * s * of_s_, theta_one(c2) * c * of_c_, theta_four(c2) * of_d_, theta_four(s2) * of_w_};
  }

 private:
  PENDULA_INLINE wide<S> theta_one(S z) const { return sum_with_smaller(one_, z * (one1_ + z * (one2_ + z * one3_))); }
  PENDULA_INLINE wide<S> theta_four(S z) const {
    return sum_with_smaller(four_, z * (four1_ + z * (four2_ + z * (four3_ + z * four4_))));
  }

  wide<S> one_, four_, of_s_, of_c_, of_d_, of_w_;
  S one1_, one2_, one3_, four1_, four2_, four3_, four4_;
};

// For moduli near 1. All is over 2 q'^¼ / (2 E), with E = e^−y, y = πu/2K', and G = q'/E² = e^−2(y_K − y), 1 at u = K.
template <class S>
class complementary_nome_series {
 public:
  complementary_nome_series() = default;

  // From kc and AGM(1, kc): ln(1/q') = πK/K' = π AGM(1, k)/AGM(1, kc).
  complementary_nome_series(wide<S> kc, wide<S> mean) {
    const wide<S> one(1.0), kc2 = square(kc), k = square_root(sum_with_smaller(one, -kc2));
    const wide<S> sum = sum_with_smaller(one, k), x = kc2 / square(sum);  // (1 − k)/(1 + k)
    const S x2 = x.hi * x.hi;
    const S rest = x2 * (S(0.25) + x2 * (S(5.0 / 64.0) + x2 * (S(11.0 / 256.0) + x2 * S(469.0 / 16384.0))));
    const wide<S> half_sum = scaled(sum, S(0.5)), mean_of_k = sum_with_smaller(half_sum, -(half_sum.hi * rest));
    log_ = wide_pi<S>::value() * (mean_of_k / mean);
    nome_ = choose(less(S(700.0), log_.hi), S(0.0), exponential(-log_).value.hi);
    const S p2 = nome_ * nome_, p4 = p2 * p2;
    const wide<S> two = sum_with_smaller(one, p2 + p2 * p4);
    const wide<S> three = sum_with_smaller(one, S(2.0) * nome_ + S(2.0) * p4);
    const wide<S> four = sum_with_smaller(one, S(-2.0) * nome_ + S(2.0) * p4);
    of_s_ = square(three);  // θ3/θ4, θ2/θ4 and θ2/θ3, all times θ3 θ4
    of_c_ = two * three;
    of_d_ = two * four;
    of_w_ = three * four;
  }

  // At u = 2 K r, |r| ≤ 1/2.
  jacobi_quartet<S> operator()(wide<S> r) const {
    const S sign = times_sign_of(S(1.0), r.hi);
    const wide<S> size = scaled(r, sign), rest = scaled(sum_with_smaller(wide<S>(0.5), -size), S(2.0)), one(1.0);
    const auto [e, e_minus_one] = exponential(-(log_ * size));
    const auto [g, g_minus_one] = exponential(-(log_ * rest));
    const wide<S> e2 = square(e), twice_e = scaled(e, S(2.0));
    const S q = nome_, qg = q * g.hi, e4 = e2.hi * e2.hi, qe2 = q * e2.hi, q4 = (q * q) * (q * q), g2 = g.hi * g.hi;
    const S of_s = qg * qg * (q * q) * (S(1.0) + e2.hi * (S(1.0) + e2.hi * (S(1.0) + e2.hi * (S(1.0) + e2.hi)))) -
                   qg * (S(1.0) + e2.hi + e4);
    const S of_c = qe2 * qe2 * (q * q) * (S(1.0) + g.hi * (S(1.0) + g.hi * (S(1.0) + g.hi * (S(1.0) + g.hi)))) -
                   qe2 * (S(1.0) + g.hi + g2);
    const S of_d = qe2 + (qg * qg + (qe2 * qe2) * (q * q) + qg * qg * qg * (q * q * q));
    const S of_w = qg + (qe2 * qe2 + q4 * (g2 + (q * q) * (e2.hi * e4)));
    const auto times_one_plus = [](wide<S> a, S small) { return sum_with_smaller(a, a.hi * small); };
    return {times_one_plus(-(e_minus_one * sum_with_smaller(wide<S>(2.0), e_minus_one)) * sign, of_s) * of_s_,
            times_one_plus(-(twice_e * g_minus_one), of_c) * of_c_,
            twice_e * sum_with_smaller(one, sum_with_smaller(g, of_d)) * of_d_,
            sum_with_smaller(one, sum_with_smaller(e2, of_w)) * of_w_};
  }

 private:
  wide<S> log_, of_s_, of_c_, of_d_, of_w_;
  S nome_;
};

template <class S>
class jacobi_theta {
 public:
  using mask = decltype(less(S(0.0), S(0.0)));
  static constexpr double no_return = 0x1p60;  // stands for K where kc = 0: beyond every argument

  wide<S> mean;  // AGM(1, kc) = π/2K

  // From the complementary modulus, 0 ≤ kc ≤ 1, and 1/(2 kc).
  PENDULA_INLINE jacobi_theta(wide<S> kc, S half_inverse)
      : jacobi_theta(kc, arithmetic_geometric_mean<S>(choose(equal(kc.hi, S(0.0)), wide<S>(1.0), kc),
                                                      choose(equal(kc.hi, S(0.0)), S(0.5), half_inverse))) {}
  PENDULA_INLINE explicit jacobi_theta(wide<S> kc) : jacobi_theta(kc, S(0.5) / kc.hi) {}

  // At u = 2 K r for |r| ≤ 1/2.
  PENDULA_INLINE jacobi_quartet<S> operator()(wide<S> r) const {
    jacobi_quartet<S> values = far_(r);
    if (any_lane(is_near_)) values = chosen(is_near_, near_, r, values);
    return values;
  }

 private:
  PENDULA_INLINE jacobi_theta(wide<S> kc, const arithmetic_geometric_mean<S>& agm)
      : mean(choose(equal(kc.hi, S(0.0)), wide<S>(std::numbers::pi / 2 / no_return), agm.value)),
        is_near_(less(kc.hi, S(near_one))),
        far_(agm.root) {
    if (any_lane(is_near_)) near_ = made(kc, mean);
  }

  // Seldom needed, and out of the way of the registers of what is.
  [[gnu::noinline]] static complementary_nome_series<S> made(wide<S> kc, wide<S> mean) { return {kc, mean}; }
  [[gnu::noinline]] static jacobi_quartet<S> chosen(mask is_near, complementary_nome_series<S> near, wide<S> r,
                                                    jacobi_quartet<S> far) {
    const jacobi_quartet<S> close = near(r);
    return {choose(is_near, close.s, far.s), choose(is_near, close.c, far.c), choose(is_near, close.d, far.d),
            choose(is_near, close.w, far.w)};
  }

  mask is_near_;
  nome_series<S> far_;
  complementary_nome_series<S> near_;
};

}  // namespace pendula::inline PENDULA_MACHINE
