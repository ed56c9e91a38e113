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
  std::array<double, most + 1> a{}, c{};
  int iterations = 0;

  explicit agm_scale(modulus m) {
    a[0] = std::isnan(m.k) ? m.k : 1.0;
    c[0] = m.k;
    double b = m.kc;
    while (iterations < most && std::fabs(c[iterations]) > 0x1p-53 * a[iterations]) {
      const double mean = 0.5 * (a[iterations] + b), half_distance = 0.5 * (a[iterations] - b);
      b = std::sqrt(a[iterations] * b);
      a[++iterations] = mean;
      c[iterations] = half_distance;
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

// For one modulus, any number of arguments.
class jacobi {
 public:
  explicit jacobi(modulus m) : m_(m), scale_(m), half_period_(2.0 * complete_elliptic_K(m)) {}

  jacobi_values operator()(double u) const {
    if (m_.kc == 0.0) return hyperbolic(u);  // DLMF 22.5.4
    const double n = std::nearbyint(u / half_period_), r = u - n * half_period_;
    const double phi = amplitude(r), sign = std::fmod(n, 2.0) == 0.0 ? 1.0 : -1.0;
    const double cosine = std::cos(phi);
    return {n * std::numbers::pi + phi, sign * std::sin(phi), sign * cosine, std::hypot(m_.kc, m_.k * cosine)};
  }

  double half_period() const { return half_period_; }

 private:
  static jacobi_values hyperbolic(double u) {
    const double sech = 1.0 / std::cosh(u);
    return {2.0 * std::atan(std::tanh(0.5 * u)), std::tanh(u), sech, sech};
  }

  // sin(2φ_{n−1} − φ_n) = (c_n/a_n) sin φ_n down from φ_N = 2^N a_N u: DLMF 22.20.3–4.
  double amplitude(double u) const {
    const int last = scale_.iterations;
    double phi = std::ldexp(scale_.limit() * u, last);
    for (int n = last; n > 0; --n) phi = 0.5 * (phi + std::asin(scale_.c[n] / scale_.a[n] * std::sin(phi)));
    return phi;
  }

  modulus m_;
  agm_scale scale_;
  double half_period_;
};

}  // namespace pendula
