// What the closed form of the damped, driven linear pendulum takes from its parameters and from a state, with many
// digits: where roots and drive nearly meet, all but a few of the digits of their differences cancel.
#pragma once

#include "pendula/exact/many_digits.hpp"
#include "pendula/scalar/wide_complex.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Each is taken exactly as given. Length, mass and gravity are above zero, the friction is not below.
struct driven_linear_parameters {
  double length, gravity, mass;
  double viscous;          // N m s
  double torque;           // N m: largest torque of the drive
  double drive_frequency;  // rad/s
  double drive_phase;      // rad, at time 0
};

namespace detail {

struct many_complex {
  many_digits re, im;

  friend many_complex operator*(const many_complex& a, const many_complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  // What is divided by zero is not asked for: it becomes zero.
  friend many_complex operator/(const many_complex& a, const many_complex& b) {
    const many_digits size = b.re * b.re + b.im * b.im;
    if (size == 0) return {0, 0};
    return {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
  }
};

inline wide_complex wide_of(const many_complex& x) { return {pendula::wide_of(x.re), pendula::wide_of(x.im)}; }
inline double size_of(const many_complex& x) {
  return sqrt(many_digits(x.re * x.re + x.im * x.im)).convert_to<double>();
}

}  // namespace detail

// θ̈ + 2γ θ̇ + ωn² θ = Re(F e^{iΩt}), with t from the start: the roots λ = −γ ± √(γ² − ωn²) of the characteristic
// polynomial, with the slower one or that above the real axis first, and amplitudes of two motions that the drive
// forces.
struct driven_linear_constants {
  many_digits damping, frequency_squared, drive;  // γ, ωn², Ω
  many_digits discriminant, root;                 // γ² − ωn², and the root of its size
  bool overdamped;
  detail::many_complex first, second;  // λ1, λ2
  detail::many_complex force;          // F
  detail::many_complex passing;        // F/(iΩ − λ2)
  detail::many_complex steady;         // F/((iΩ − λ1)(iΩ − λ2))

  driven_linear_constants(const driven_linear_parameters& of, double t0)
      : drive(abs(many_digits(of.drive_frequency))), overdamped(false), force{0, 0} {
    const many_digits inertia = many_digits(of.mass) * of.length * of.length;
    damping = of.viscous / (2 * inertia);
    frequency_squared = many_digits(of.gravity) / of.length;
    discriminant = damping * damping - frequency_squared;
    root = sqrt(abs(discriminant));
    overdamped = discriminant > 0;
    const many_digits fast = damping + root;
    if (overdamped) {  // λ1 as the quotient, of which nothing cancels
      first = {-frequency_squared / fast, 0};
      second = {-fast, 0};
    } else {
      first = {-damping, root};
      second = {-damping, -root};
    }
    if (of.torque != 0.0) {
      const many_digits size = of.torque / inertia;
      const many_digits phase = (many_digits(of.drive_frequency) * t0 + of.drive_phase) *
                                (of.drive_frequency < 0.0 ? -1 : 1);  // the cosine is even
      force = {size * cos(phase), size * sin(phase)};
    }
    passing = force / detail::many_complex{-second.re, drive - second.im};
    steady = passing / from_first_to_drive();
  }

  detail::many_complex from_first_to_drive() const { return {-first.re, drive - first.im}; }  // iΩ − λ1
};

// The free motion from a state: θ is the real part of `first` e^{λ1 t}, and `second` e^{λ2 t} of an overdamped one; ω
// that of the others.
struct free_modes {
  wide_complex first, first_rate;
  wide<double> second, second_rate;

  free_modes() = default;
  free_modes(const driven_linear_constants& of, const many_digits& theta, const many_digits& omega) {
    detail::many_complex amplitude{theta, 0};
    second = second_rate = wide<double>(0.0);
    if (of.root == 0)
      amplitude.im = 0;  // not asked for where the roots are one
    else if (of.overdamped) {
      const many_digits inverse = 1 / (2 * of.root);
      const many_digits other = (of.first.re * theta - omega) * inverse;
      amplitude.re = (omega - of.second.re * theta) * inverse;
      second = wide_of(other);
      second_rate = wide_of(many_digits(other * of.second.re));
    } else {
      amplitude.im = -(omega + of.damping * theta) / of.root;
    }
    first = detail::wide_of(amplitude);
    first_rate = detail::wide_of(amplitude * of.first);
  }
};

// The same with what stays apart where the roots meet: e^{−γt} (even cosh(rt) + odd sinh(rt)/r), r² = γ² − ωn².
struct free_series {
  wide<double> theta_even, theta_odd, omega_even, omega_odd;

  free_series() = default;
  free_series(const driven_linear_constants& of, const many_digits& theta, const many_digits& omega)
      : theta_even(wide_of(theta)),
        theta_odd(wide_of(many_digits(omega + of.damping * theta))),
        omega_even(wide_of(omega)),
        omega_odd(wide_of(many_digits(-(of.damping * omega + of.frequency_squared * theta)))) {}
};

// What is left of a state beside each of the forced motions that `driven_linear.hpp` takes.
struct driven_start {
  free_modes beside_steady, beside_passing;
  free_series meeting_beside_steady, meeting;

  driven_start() = default;
  driven_start(const driven_linear_constants& of, double theta, double omega) {
    const many_digits left = theta - of.steady.re, left_omega = omega + of.drive * of.steady.im;
    beside_steady = free_modes(of, left, left_omega);
    meeting_beside_steady = free_series(of, left, left_omega);
    if (of.force.re == 0 && of.force.im == 0) return;
    beside_passing = free_modes(of, theta, omega - of.passing.re);
    meeting = free_series(of, theta, omega);
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
