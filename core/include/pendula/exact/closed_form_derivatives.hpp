// The closed forms over numbers of a hundred digits that carry their derivatives by start and parameters. So many
// digits need no care next to a regime's boundary; from it what is given is moved off by a part of 1e-40, which no
// double sees.
#pragma once

#include <vector>

#include "pendula/exact/many_digits.hpp"
#include "pendula/scalar/dual.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr int exact_derived_at_once = 4;
using many_digit_dual = dual<exact_derived_at_once, many_digits>;

inline many_digit_dual square_root(const many_digit_dual& x) {
  using tangents = many_digit_dual::tangents;
  const many_digits root = sqrt(x.value);
  return {root, x.change / tangents(2 * root)};
}
inline sine_cosine<many_digit_dual> sincos(const many_digit_dual& x) {
  using tangents = many_digit_dual::tangents;
  const many_digits s = sin(x.value), c = cos(x.value);
  return {{s, x.change * tangents(c)}, {c, x.change * tangents(-s)}};
}
inline many_digit_dual exponential(const many_digit_dual& x) {
  const many_digits e = exp(x.value);
  return {e, x.change * many_digit_dual::tangents(e)};
}
inline many_digit_dual moved(many_digit_dual x) {
  x.value *= 1 + many_digits("1e-40");
  return x;
}

// sn, cn and dn of one modulus by Gauss's transformation (DLMF 22.7.2–4), from kc² > 0.
class jacobi_in_many_digits {
 public:
  using S = many_digit_dual;
  struct values {
    S s, c, d;
  };

  explicit jacobi_in_many_digits(const S& complement_squared) {
    S complement = square_root(complement_squared);
    for (;;) {
      const S one(1.0), k1 = (one - complement) / (one + complement);
      stretch_ = stretch_ / (one + k1);
      if (abs(k1.value) < 1e-52) return;  // whose square is beyond the digits
      moduli_.push_back(k1);
      complement = S(2.0) * square_root(complement) / (one + complement);
    }
  }

  values operator()(const S& u) const {
    const auto [sine, cosine] = sincos(u * stretch_);
    values v{sine, cosine, S(1.0)};
    for (auto k1 = moduli_.rbegin(); k1 != moduli_.rend(); ++k1) {
      const S one(1.0), part = *k1 * v.s * v.s, inverse = one / (one + part);
      v = {(one + *k1) * v.s * inverse, v.c * v.d * inverse, (one - part) * inverse};
    }
    return v;
  }

 private:
  S stretch_{1.0};
  std::vector<S> moduli_;  // from the largest on
};

// The simple pendulum, by the sums of exact/simple.hpp.
class simple_with_derivatives {
 public:
  using S = many_digit_dual;

  simple_with_derivatives(const S& length, const S& gravity, const S& theta, const S& omega, const many_digits& t0)
      : t0_(t0), frequency_(square_root(gravity / length)), jacobi_(S(1.0)) {
    const auto [sine, cosine] = sincos(theta * S(0.5));
    a_ = sine, c_ = cosine, b_ = omega / (S(2.0) * frequency_);
    if (abs(c_.value) == abs(b_.value)) b_ = moved(b_);  // on the separatrix
    const S difference = c_ * c_ - b_ * b_;
    rotating_ = difference.value < 0;
    if (rotating_) stretch_ = square_root(a_ * a_ + b_ * b_);
    jacobi_ = jacobi_in_many_digits(rotating_ ? -difference / (stretch_ * stretch_) : difference);
  }

  // Derivatives of θ and ω.
  std::array<S::tangents, 2> at(const many_digits& t) const {
    auto [s, c, d] = jacobi_(frequency_ * S(many_digits(t - t0_)) * stretch_);
    if (rotating_) {
      std::swap(c, d);
      s = s / stretch_;
    }
    const S inverse = S(1.0) / (c_ * c_ + a_ * a_ * c * c);
    const S sine = (a_ * c * d + b_ * c_ * s) * inverse, cosine = (c_ * d - a_ * b_ * s * c) * inverse;
    const S omega = S(2.0) * frequency_ * (b_ * c - a_ * c_ * s * d) * inverse;
    using tangents = S::tangents;
    return {tangents(2.0) * (tangents(cosine.value) * sine.change - tangents(sine.value) * cosine.change),
            omega.change};
  }

 private:
  many_digits t0_;
  S frequency_, a_, b_, c_, stretch_{1.0};
  jacobi_in_many_digits jacobi_;
  bool rotating_;
};

// The linear pendulum with friction γ and a drive F cos(Ω t + φ), all per moment of inertia: what the drive keeps up
// and a free motion.
class linear_with_derivatives {
 public:
  using S = many_digit_dual;
  struct constants {
    S frequency_squared, friction, force, drive_frequency, phase;
  };
  struct pair {
    S theta, omega;
  };

  linear_with_derivatives(const constants& of, const S& theta, const S& omega, const many_digits& t0)
      : of_(of), t0_(t0) {
    const auto square = [](const S& x) { return x * x; };
    const many_digits frequency_squared = of.frequency_squared.value;
    if (of.friction.value == 0 && square(of.drive_frequency).value == frequency_squared)
      of_.drive_frequency = moved(of.drive_frequency);                                          // at resonance
    if (square(of.friction).value == 4 * frequency_squared) of_.friction = moved(of.friction);  // critical damping
    const S distance = of_.frequency_squared - square(of_.drive_frequency);
    const S across = of_.friction * of_.drive_frequency, size = square(distance) + square(across);
    in_phase_ = of_.force * distance / size;
    behind_ = of_.force * across / size;
    turning_ = of_.frequency_squared - square(S(0.5) * of_.friction);
    const pair forced = kept_up(t0);
    start_ = {theta - forced.theta, omega - forced.omega};
  }

  std::array<S::tangents, 2> at(const many_digits& t) const {
    const S half = S(0.5) * of_.friction, elapsed(many_digits(t - t0_)), decay = exponential(-half * elapsed);
    const auto [sine, cosine] = sine_over(elapsed);
    const S push = start_.omega + half * start_.theta;
    const pair forced = kept_up(t);
    const S theta = forced.theta + decay * (start_.theta * cosine + push * sine);
    const S omega = forced.omega + decay * (start_.omega * cosine -
                                            (half * start_.omega + of_.frequency_squared * start_.theta) * sine);
    return {theta.change, omega.change};
  }

 private:
  pair kept_up(const many_digits& t) const {
    const auto [sine, cosine] = sincos(of_.drive_frequency * S(t) + of_.phase);
    return {in_phase_ * cosine + behind_ * sine, of_.drive_frequency * (behind_ * cosine - in_phase_ * sine)};
  }
  // sin(wt)/w and cos(wt); hyperbolic functions beyond critical damping.
  sine_cosine<S> sine_over(const S& t) const {
    if (turning_.value > 0) {
      const S w = square_root(turning_);
      const auto [sine, cosine] = sincos(w * t);
      return {sine / w, cosine};
    }
    const S w = square_root(-turning_), grown = exponential(w * t), fallen = S(1.0) / grown;
    return {S(0.5) * (grown - fallen) / w, S(0.5) * (grown + fallen)};
  }

  constants of_;
  many_digits t0_;
  S in_phase_, behind_, turning_;
  pair start_;
};

}  // namespace pendula::inline PENDULA_MACHINE
