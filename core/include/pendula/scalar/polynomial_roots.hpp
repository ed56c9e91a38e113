// All crossings of zero of a polynomial on an interval, however close together.
#pragma once

#include <array>
#include <cmath>

#include "pendula/build.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr int most_coefficients = 65;

struct polynomial {
  std::array<double, most_coefficients> coefficient{};
  int degree = 0;

  double operator()(double x) const {
    double sum = coefficient[degree];
    for (int k = degree - 1; k >= 0; --k) sum = sum * x + coefficient[k];
    return sum;
  }
  double slope(double x) const {
    double sum = 0.0;
    for (int k = degree; k >= 1; --k) sum = sum * x + k * coefficient[k];
    return sum;
  }
  // How far it can be from its first coefficient on [−r, r].
  double reach(double r) const {
    double sum = 0.0;
    for (int k = degree; k >= 1; --k) sum = (sum + std::fabs(coefficient[k])) * r;
    return sum;
  }
  // The polynomial q(y) = p(centre + radius y): Horner's scheme, repeated.
  polynomial about(double centre, double radius) const {
    polynomial q = *this;
    for (int j = 0; j < degree; ++j)
      for (int k = degree - 1; k >= j; --k) q.coefficient[k] += centre * q.coefficient[k + 1];
    double power = 1.0;
    for (int k = 1; k <= degree; ++k) q.coefficient[k] *= power *= radius;
    return q;
  }
};

namespace detail {

inline constexpr double narrowest = 0x1p-36;  // of the interval: what is left is a touch, at the level of rounding

// Where a polynomial that rises or falls throughout [a, b] passes zero, its signs at the ends being different: Newton's
// method, and the interval halved where that leaves it.
inline double only_root(const polynomial& p, double a, double b, bool rising) {
  double x = 0.5 * (a + b);
  for (int i = 0; i < 100; ++i) {
    const double value = p(x);
    if (value == 0.0) return x;  // on neither side: a falling root is where a rising one would be
    if ((value < 0.0) == rising) {
      a = x;
    } else {
      b = x;
    }
    double next = x - value / p.slope(x);
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (next == x || next <= a || next >= b) return next;
    x = next;
  }
  return x;
}

template <class Visit>
void crossings_within(const polynomial& p, double a, double b, double noise, Visit& visit) {
  const double centre = 0.5 * (a + b), radius = 0.5 * (b - a);
  const polynomial q = p.about(centre, radius);
  const double reach = q.reach(1.0);
  double bends = 0.0;
  for (int k = 2; k <= q.degree; ++k) bends += k * std::fabs(q.coefficient[k]);
  if (std::fabs(q.coefficient[0]) > reach) return;  // too far from zero
  if (std::fabs(q.coefficient[1]) > bends || reach <= noise || radius < narrowest) {
    const bool below_first = p(a) < 0.0, below_last = p(b) < 0.0;
    if (below_first != below_last) visit(only_root(p, a, b, below_first), below_first);
    return;
  }
  crossings_within(p, a, centre, noise, visit);
  crossings_within(p, centre, b, noise, visit);
}

}  // namespace detail

// Calls visit(x, rising) for every x in [0, end] where p changes its sign, in their order. Sums of magnitudes about the
// middle show that an interval holds none, or that p rises or falls throughout; it is halved until one of them does, or
// until p changes by no more than `noise`, its rounding.
template <class Visit>
void each_crossing(const polynomial& p, double end, double noise, Visit&& visit) {
  const double reach = p.reach(end);
  if (std::fabs(p.coefficient[0]) > reach || reach <= noise) return;
  detail::crossings_within(p, 0.0, end, noise, visit);
}

}  // namespace pendula::inline PENDULA_MACHINE
