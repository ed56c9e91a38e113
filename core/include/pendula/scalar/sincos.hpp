// Sine and cosine together, the same bits for a number and for every lane, on every machine, for |x| below
// `largest_angle`; from there on the results are not finite, which ends a run, never a silently wrong number.
#pragma once

#include "pendula/scalar/pack.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr double largest_angle = 0x1p26;  // 1.07e7 turns
// The error is below the sum of both: units in the last place of the result, and parts of the angle, far less than
// the angle's own rounding, that show where the result is next to zero.
inline constexpr double sincos_ulps = 1.5, sincos_of_angle = 0x1p-82;

template <class S>
struct sine_cosine {
  S sin, cos;
};

// x − n π/2, at most π/4 in size, and n modulo 4 in the low bits of `quadrant`. π/2 in two parts, of 27 and 53 bits
// (Cody & Waite 1980): n < 2^26 times the first is exact.
template <class S>
PENDULA_INLINE auto reduce_by_half_pi(S x) {
  struct reduced {
    S angle;
    decltype(bits(x)) quadrant;
  };
  const S nearest_integer_magic(0x1.8p52);  // adding 1.5·2^52 leaves the nearest integer in the low bits
  const S overflowing = x * S(0x1p1023 / largest_angle * 2.0);                        // infinite from largest_angle on
  const S shifted = overflowing * S(0x1.45f306dc9c883p-999) + nearest_integer_magic;  // x 2/π otherwise
  const S n = shifted - nearest_integer_magic;
  return reduced{(x - n * S(0x1.921fb54p+0)) - n * S(0x1.10b4611a62633p-30), bits(shifted)};
}

// What sin x has beyond x, and cos x beyond 1 − z/2, z = x², for |x| ≤ π/4, with error below 2^-58: the coefficients of
// fdlibm's k_sin.c and k_cos.c (Sun Microsystems 1993), summed in pairs (Estrin 1960): a run of one trajectory waits
// for them.
template <class S>
PENDULA_INLINE sine_cosine<S> sincos_remainders(S x, S z) {
  const S w = z * z, cube = z * x;
  const S p =
      (S(8.33333333332248946124e-03) + z * S(-1.98412698298579493134e-04)) +
      w * ((S(2.75573137070700676789e-06) + z * S(-2.50507602534068634195e-08)) + w * S(1.58969099521155010221e-10));
  const S q = (S(4.16666666666666019037e-02) + z * S(-1.38888888888741095749e-03)) +
              w * ((S(2.48015872894767294178e-05) + z * S(-2.75573143513906633035e-07)) +
                   w * (S(2.08757232129817482790e-09) + z * S(-1.13596475577881948265e-11)));
  return {cube * (S(-1.66666666666666324348e-01) + z * p), w * q};
}

template <class S>
PENDULA_INLINE sine_cosine<S> sincos_polynomials(S x) {
  const S z = x * x;
  const auto [sine, cosine] = sincos_remainders(x, z);
  return {x + sine, S(1.0) - (S(0.5) * z - cosine)};
}

// The functions of numbers that are made of several: specialised where those are defined.
template <class S>
struct elementary;

template <class S>
PENDULA_INLINE sine_cosine<S> sincos(S x)
  requires(!has_bit_pattern<S>)
{
  return elementary<S>::sincos(x);
}

template <class S>
PENDULA_INLINE sine_cosine<S> sincos(S x)
  requires has_bit_pattern<S>
{
  const auto r = reduce_by_half_pi(x);
  const auto [s, c] = sincos_polynomials(r.angle);
  // odd quadrants exchange sine and cosine: through their difference in bits, without a branch
  const auto exchange = (bits(s) ^ bits(c)) & -(r.quadrant & 1);
  // quadrants 2, 3 turn the sign of the sine, 1, 2 that of the cosine: bit 1, and bit 1 plus bit 0, as the sign bit
  const auto change = exchange ^ ((r.quadrant & 2) << 62), odd_sign = r.quadrant << 63;
  return {from_bits<S>(bits(s) ^ change), from_bits<S>(bits(c) ^ change ^ odd_sign)};
}

// Of two angles: a plain number puts them in two lanes, which takes as long as one.
template <class S>
PENDULA_INLINE std::array<sine_cosine<S>, 2> sincos(S x, S y) {
  return {sincos(x), sincos(y)};
}
PENDULA_INLINE std::array<sine_cosine<double>, 2> sincos(double x, double y) {
  pack<double, 2> pair(x);
  pair.set(1, y);
  const auto [s, c] = sincos(pair);
  return {{{s[0], c[0]}, {s[1], c[1]}}};
}

// 1 − cos x without cancellation for small x.
template <class S>
S one_minus_cos(S x) {
  const S s = sincos(S(0.5) * x).sin;
  return S(2.0) * s * s;
}

}  // namespace pendula::inline PENDULA_MACHINE
