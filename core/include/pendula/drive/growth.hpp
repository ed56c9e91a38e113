// How variations of a motion grow: the logarithms of their lengths, and Cincotta and Simó's MEGNO, by Gauss's formula
// inside each step.
#pragma once

#include <array>

#include "pendula/scalar/logarithm.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr double ln_2 = 0x1.62e42fefa39efp-1;

template <class S>
PENDULA_INLINE S square_of_length(const vec<S, 4>& v) {
  return (v[0] * v[0] + v[1] * v[1]) + (v[2] * v[2] + v[3] * v[3]);
}

// Gauss's formula with eight nodes (Abramowitz & Stegun 1964, table 25.4) on [0, 1], and that for the integrals from 0
// to each of the nodes, which is exact for polynomials of degree 7.
struct gauss_of_eight {
  static constexpr int count = 8;
  std::array<double, count> node{}, weight{};
  std::array<std::array<double, count>, count> up_to{};

  constexpr gauss_of_eight() {
    constexpr double half[4][2] = {{0.183434642495649804939, 0.362683783378361982965},
                                   {0.525532409916328985818, 0.313706645877887287338},
                                   {0.796666477413626739592, 0.222381034453374470544},
                                   {0.960289856497536231684, 0.101228536290376259153}};
    std::array<double, count> x{};
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = i < 4 ? 3 - i : i - 4;
      x[i] = i < 4 ? -half[place][0] : half[place][0];
      node[i] = 0.5 + 0.5 * x[i];
      weight[i] = 0.5 * half[place][1];
    }
    // the interpolant through the nodes in Legendre polynomials, whose integrals are differences of two of them
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const auto at = legendre(x[i]), of = legendre(x[j]);
        double sum = x[i] + 1.0;
        for (std::size_t k = 1; k < count; ++k) sum += of[k] * (at[k + 1] - at[k - 1]);
        up_to[i][j] = 0.5 * weight[j] * sum;
      }
  }

 private:
  // P_0 … P_8 (DLMF 18.9.1)
  static constexpr std::array<double, count + 1> legendre(double x) {
    std::array<double, count + 1> p{1.0, x};
    for (std::size_t k = 1; k < count; ++k) {
      const auto n = static_cast<double>(k);
      p[k + 1] = ((2.0 * n + 1.0) * x * p[k] - n * p[k - 1]) / (n + 1.0);
    }
    return p;
  }
};
inline constexpr gauss_of_eight gauss_8;

// With L = ln|δ(t)|/|δ(0)| and I = ∫L dt, MEGNO is Y = 2 (L − I/t), and its mean is ∫Y dt/t (Cincotta & Simó 2000,
// Astron. Astrophys. Suppl. 147, 205, eqs. 19 and 21, integrated by parts).
template <class S>
struct megno_integrals {
  S of_growth{0.0};  // I
  S of_megno{0.0};   // ∫Y dt

  // After a step h from the time t on, with L at its nodes.
  PENDULA_INLINE megno_integrals after(S t, S h, const std::array<S, gauss_of_eight::count>& growth) const {
    megno_integrals next = *this;
    S whole(0.0), parts(0.0);
    for (std::size_t i = 0; i < gauss_of_eight::count; ++i) {
      S up_to(0.0);
      for (std::size_t j = 0; j < gauss_of_eight::count; ++j) up_to = up_to + S(gauss_8.up_to[i][j]) * growth[j];
      const S weight(gauss_8.weight[i]);
      whole = whole + weight * growth[i];
      parts = parts + weight * (growth[i] - (of_growth + h * up_to) / (t + h * S(gauss_8.node[i])));
    }
    next.of_growth = of_growth + h * whole;
    next.of_megno = of_megno + S(2.0) * h * parts;
    return next;
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
