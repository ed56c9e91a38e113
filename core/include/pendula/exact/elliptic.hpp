// Jacobi elliptic functions and the complete integral K by the arithmetic–geometric mean: DLMF 19.8(i), 22.20(ii).
// Everything takes the modulus k together with its complement kc = √(1 − k²), each known to its own last bit.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace pendula {

struct modulus {
  double k, kc;

  static modulus from_k(double k) { return {k, std::sqrt((1.0 - k) * (1.0 + k))}; }
  static modulus from_kc(double kc) { return {std::sqrt((1.0 - kc) * (1.0 + kc)), kc}; }
};

// The means a_n, b_n and c_n = (a_{n−1} − b_{n−1})/2 from 1, kc, k (DLMF 19.8.1–3). The distance of the means is
// squared each time, so they meet after few iterations even where kc is tiny.
struct agm_scale {
  static constexpr int most = 16;
  std::array<double, most + 1> a{}, b{}, c{};
  int iterations = 0;

  explicit agm_scale(modulus m) {
    a[0] = std::isnan(m.k) ? m.k : 1.0;
    b[0] = m.kc;
    c[0] = m.k;
    while (iterations < most && std::fabs(c[iterations]) > 0x1p-53 * a[iterations]) {
      const double high = a[iterations], low = b[iterations];
      ++iterations;
      a[iterations] = 0.5 * (high + low);
      b[iterations] = std::sqrt(high * low);
      c[iterations] = 0.5 * (high - low);
    }
  }
  double limit() const { return a[iterations]; }
};

// K = π / (2 AGM(1, kc)), DLMF 19.8.5.
inline double complete_elliptic_K(const agm_scale& scale) { return 0.5 * std::numbers::pi / scale.limit(); }
inline double complete_elliptic_K(modulus m) { return m.kc == 0.0 ? INFINITY : complete_elliptic_K(agm_scale(m)); }

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

struct jacobi_values {
  double am, sn, cn, dn;
};

// For one modulus, any number of arguments. sn, cn and dn keep their own last digits, also where they are small.
class jacobi {
 public:
  explicit jacobi(modulus m) : m_(m), scale_(m), quarter_period_(complete_elliptic_K(m)) {}

  jacobi_values operator()(double u) const {
    if (m_.kc == 0.0) return with_amplitude(0.0, 1.0, hyperbolic(u));  // DLMF 22.5.4
    const double half_period = 2.0 * quarter_period_;
    const double n = std::nearbyint(u / half_period), r = u - n * half_period;
    return with_amplitude(n * std::numbers::pi, std::fmod(n, 2.0) == 0.0 ? 1.0 : -1.0, within_half_period(r));
  }

 private:
  struct values {
    double sn, cn, dn;
  };

  static jacobi_values with_amplitude(double turned, double sign, values v) {
    return {turned + std::atan2(v.sn, v.cn), sign * v.sn, sign * v.cn, v.dn};
  }

  // Beyond K/2 through the distance v from K: sn = cn v/dn v, cn = kc sn v/dn v, dn = kc/dn v (DLMF table 22.4.3).
  values within_half_period(double r) const {
    const double v = quarter_period_ - std::fabs(r);
    if (std::fabs(r) <= v) return small(r);
    const auto [sn, cn, dn] = small(v);
    return {std::copysign(cn / dn, r), m_.kc * sn / dn, m_.kc / dn};
  }

  values small(double u) const { return m_.k <= m_.kc ? by_amplitude(u) : by_ascent(u, m_); }

  // sin(2φ_{n−1} − φ_n) = (c_n/a_n) sin φ_n down from φ_N = 2^N a_N u: DLMF 22.20.3–4. Its cosine follows from
  // a² − c² = b² without cancellation.
  values by_amplitude(double u) const {
    double phi = std::ldexp(scale_.limit() * u, scale_.iterations);
    for (int n = scale_.iterations; n > 0; --n) {
      const double s = std::sin(phi), c = std::cos(phi);
      phi = 0.5 * (phi + std::atan2(scale_.c[n] * s, std::hypot(scale_.a[n] * c, scale_.b[n] * s)));
    }
    const double cn = std::cos(phi);
    return {std::sin(phi), cn, std::hypot(m_.kc, m_.k * cn)};
  }

  // Ascending Landen transformation, DLMF 22.7.6–8: it squares kc each time, until they are hyperbolic.
  static values by_ascent(double u, modulus m) {
    if (m.kc < 0x1p-56) return hyperbolic(u);
    const double kc = m.kc / (1.0 + m.k), next_kc = kc * kc;
    const modulus next = modulus::from_kc(next_kc);
    const auto [sn, cn, dn] = by_ascent(u / (1.0 + next_kc), next);
    const double below = next.k * next.k * dn, square = dn * dn;
    return {(1.0 + next_kc) * sn * cn / dn, (1.0 + next_kc) * (square - next_kc) / below,
            (1.0 - next_kc) * (square + next_kc) / below};
  }

  static values hyperbolic(double u) {
    const double sech = 1.0 / std::cosh(u);
    return {std::tanh(u), sech, sech};
  }

  modulus m_;
  agm_scale scale_;
  double quarter_period_;
};

}  // namespace pendula
