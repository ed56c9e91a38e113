// The incomplete elliptic integral of the first kind, of any amplitude.
#pragma once

#include "pendula/exact/elliptic.hpp"
#include "pendula/scalar/wide_sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr double incomplete_ulps = 1.0;  // what F lies within, in units in the last place
inline constexpr double many_turns = 0x1p62;    // amplitudes beyond are proportional to F, but for one part in 2^61

namespace detail {

// numerator R_F(x, y, 1) for x, y > 0. R_F stays the same when x, y and z become (x + λ)/4, …, which brings them a
// quarter as far apart, and then is (1 + rest)/√A with a series in what is left (Carlson 1995; DLMF 19.26.18, 19.36.1).
inline wide<double> carlson_RF(wide<double> x, wide<double> y, wide<double> numerator) {
  wide<double> z(1.0), a;
  double X, Y;
  for (;;) {
    a = quick_sum(quick_sum(x, y), z) / wide<double>(3.0);
    X = ((a.hi - x.hi) + (a.lo - x.lo)) / a.hi;
    Y = ((a.hi - y.hi) + (a.lo - y.lo)) / a.hi;
    if (!(std::fabs(X) >= 0x1p-8 || std::fabs(Y) >= 0x1p-8)) break;
    const wide<double> rx = square_root(x), ry = square_root(y), rz = square_root(z);
    const wide<double> lambda = quick_sum(rx * ry, rz * quick_sum(rx, ry));
    x = scaled(quick_sum(x, lambda), 0.25);
    y = scaled(quick_sum(y, lambda), 0.25);
    z = scaled(quick_sum(z, lambda), 0.25);
  }
  const double Z = -(X + Y), e2 = X * Y - Z * Z, e3 = X * Y * Z;
  const double rest = e2 * (-1.0 / 10 + e2 * (1.0 / 24 - e2 * (5.0 / 208)) + e3 * (-3.0 / 44 + e2 / 16)) +
                      e3 * (1.0 / 14 + e3 * (3.0 / 104));
  const wide<double> value = numerator / square_root(a);
  return sum_with_smaller(value, value.hi * rest);
}

// φ = nπ + an angle in [−π/2, π/2] with this sine and cosine.
struct counted_amplitude {
  wide<double> half_turns, sine, cosine;
};

inline counted_amplitude count_half_turns(double phi) {
  if (std::fabs(phi) < largest_wide_angle) {
    const auto [sine, cosine] = wide_sincos(phi);
    const double near = nearest_whole(phi * 0x1.45f306dc9c883p-2), sign = parity_sign(near);  // 1/π
    if (cosine.hi * sign >= 0.0) return {near, scaled(sine, sign), scaled(cosine, sign)};
    return {near + times_sign_of(1.0, sine.hi * sign), scaled(sine, -sign), scaled(cosine, -sign)};
  }
  const auto [quarters, rest] = quarter_turns_off(phi);
  auto [s, c] = wide_sincos(rest.hi);  // and on by the tail, whose square is below the last bit
  const wide<double> sine = sum_with_smaller(s, c * rest.lo), cosine = sum_with_smaller(c, -(s * rest.lo));
  const std::int64_t n = (quarters + (quarters & 1 && sine.hi > 0.0 ? 1 : 0)) >> 1;
  const double head = static_cast<double>(n);
  const wide<double> half_turns{head, static_cast<double>(n - static_cast<std::int64_t>(head))};
  if ((quarters & 1) == 0) return {half_turns, sine, cosine};
  const double sign = sine.hi > 0.0 ? -1.0 : 1.0;  // short of the half turn, or beyond the one before
  return {half_turns, scaled(cosine, sign), scaled(sine, -sign)};
}

// For k > 1, with 1 − k² sin² φ as a product.
inline double incomplete_F_beyond_one(double phi, const modulus<double>& m) {
  if (!(std::fabs(phi) < 2.0)) return NAN;
  const auto [sine, cosine] = wide_sincos(phi);
  const wide<double> part = scaled(sine * m.stretch.hi, times_sign_of(1.0, phi)), one(1.0);
  const wide<double> left = settled(quick_sum(one, -part));
  if (!(left.hi > 0.0 && cosine.hi > 0.0)) return NAN;
  return rounded(carlson_RF(square(cosine), left * quick_sum(one, part), sine));
}

}  // namespace detail

// F(φ, k) = 2nK + sin φ' R_F(cos² φ', 1 − k² sin² φ', 1), φ' = φ − nπ (DLMF 19.2.10, 19.25.5). For k > 1 it is defined
// where |sin φ| ≤ 1/k and |φ| ≤ π/2, and NaN elsewhere.
inline double incomplete_F(double phi, const modulus<double>& m) {
  const double size = std::fabs(phi), stretch = m.stretch.hi;
  if (std::isnan(phi) || std::isnan(m.kc.hi)) return phi + m.kc.hi;
  if (size * stretch < tiny_argument || (m.k.hi == 0.0 && !m.given_complement)) return phi;
  if (stretch > 1.0) return detail::incomplete_F_beyond_one(phi, m);
  if (m.kc.hi == 0.0 && size > 1.6) return std::copysign(INFINITY, phi);
  if (size >= many_turns)
    return std::isinf(phi) ? phi : 0x1p200 * rounded(wide<double>(0x1p-200 * phi) / mean_and_sum<double>(m).mean);
  const auto [half_turns, sine, cosine] = detail::count_half_turns(phi);
  const wide<double> c2 = square(cosine), kc_s = m.kc * sine;
  const wide<double> rest = detail::carlson_RF(c2, quick_sum(c2, square(kc_s)), sine);
  if (half_turns.hi == 0.0) return rounded(rest);
  if (m.kc.hi == 0.0) return std::copysign(INFINITY, phi);
  const wide<double> half_period = wide_pi<double>::value() / mean_and_sum<double>(m).mean;
  return rounded(quick_sum(half_turns * half_period, rest));
}

}  // namespace pendula::inline PENDULA_MACHINE
