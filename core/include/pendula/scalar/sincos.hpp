// Sine and cosine together, the same bits for a number and for every lane, on every machine, for |x| below
// `largest_angle`; from there on the result is NaN, which ends a run, never a silently wrong number.
#pragma once

#include "pendula/scalar/pack.hpp"

namespace pendula {

inline constexpr double largest_angle = 0x1p26;  // 1.07e7 turns
inline constexpr double sincos_ulps = 0.8, sincos_absolute = 1e-25;  // the error stays below the larger

template <class S>
struct sine_cosine {
  S sin, cos;
};

// x − n π/2 as head + tail, |head| ≤ π/4, and n modulo 4 in the low bits of `quadrant`.
// π/2 in three parts of 27, 27 and 53 bits (Cody & Waite 1980): n < 2^26 times the first two is exact.
template <class S>
PENDULA_INLINE auto reduce_by_half_pi(S x) {
  struct reduced {
    S head, tail;
    decltype(bits(x)) quadrant;
  };
  const S nearest_integer_magic(0x1.8p52);  // adding 1.5·2^52 leaves the nearest integer in the low bits
  const S shifted = x * S(0x1.45f306dc9c883p-1) + nearest_integer_magic;  // 2/π
  const S n = shifted - nearest_integer_magic;
  const S first = x - n * S(0x1.921fb54p+0);
  const S product = n * S(0x1.10b461p-30), low = n * S(0x1.a62633145c06ep-58);
  const S rest = first - product, head = rest - low;
  // the rounding errors of the last two differences (Knuth 1969; Dekker 1971); the polynomials need them last
  const S back = rest - first;
  const S error = (first - (rest - back)) - (product + back);
  const S overflowing = x * S(0x1p1023 / largest_angle * 2.0);  // infinite from largest_angle on; infinity − infinity is NaN
  const S tail = (error + ((rest - head) - low)) + (overflowing - overflowing);
  return reduced{head, tail, bits(shifted)};
}

// Polynomials for |x| ≤ π/4 with error below 2^-58, from fdlibm's k_sin.c and k_cos.c (Sun Microsystems 1993).
template <class S>
PENDULA_INLINE S sin_polynomial(S x, S tail) {
  const S z = x * x, w = z * z;
  const S high = S(8.33333333332248946124e-03) + z * (S(-1.98412698298579493134e-04) + z * S(2.75573137070700676789e-06)) +
                 z * w * (S(-2.50507602534068634195e-08) + z * S(1.58969099521155010221e-10));
  const S cube = z * x;
  return x - ((z * (S(0.5) * tail - cube * high) - tail) - cube * S(-1.66666666666666324348e-01));
}

template <class S>
PENDULA_INLINE S cos_polynomial(S x, S tail) {
  const S z = x * x, w = z * z;
  const S high = z * (S(4.16666666666666019037e-02) + z * (S(-1.38888888888741095749e-03) + z * S(2.48015872894767294178e-05))) +
                 w * w * (S(-2.75573143513906633035e-07) + z * (S(2.08757232129817482790e-09) + z * S(-1.13596475577881948265e-11)));
  const S half_square = S(0.5) * z;
  const S one_minus = S(1.0) - half_square;
  return one_minus + (((S(1.0) - one_minus) - half_square) + (z * high - x * tail));
}

template <class S>
PENDULA_INLINE sine_cosine<S> sincos(S x) {
  const auto r = reduce_by_half_pi(x);
  const S s = sin_polynomial(r.head, r.tail), c = cos_polynomial(r.head, r.tail);
  // odd quadrants exchange sine and cosine: through their difference in bits, without a branch
  const auto exchange = (bits(s) ^ bits(c)) & -(r.quadrant & 1);
  // quadrants 2, 3 turn the sign of the sine, 1, 2 that of the cosine: bit 1 of n and of n + 1, moved to the sign bit
  const auto sine_sign = (r.quadrant & 2) << 62, cosine_sign = ((r.quadrant + 1) & 2) << 62;
  return {from_bits<S>(bits(s) ^ exchange ^ sine_sign), from_bits<S>(bits(c) ^ exchange ^ cosine_sign)};
}

// 1 − cos x without cancellation for small x.
template <class S>
S one_minus_cos(S x) {
  const S s = sincos(S(0.5) * x).sin;
  return S(2.0) * s * s;
}

}  // namespace pendula
