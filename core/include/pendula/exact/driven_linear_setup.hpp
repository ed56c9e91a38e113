// What the closed form of the damped, driven linear pendulum takes from its parameters and from a state, with many
// digits: where roots and drive nearly meet, all but a few of the digits of their differences cancel.
#pragma once

#include "pendula/exact/many_digits.hpp"
#include "pendula/scalar/long_number.hpp"
#include "pendula/scalar/wide_complex.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Each is taken exactly as given. Length, mass and gravity are above zero, the friction is not below; angles and
// velocities, their phases and rates of decay, and what any of them is multiplied with, lie within 2^±900 or are zero.
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
};

// The same with what stays apart where the roots meet: e^{−γt} (even cosh(rt) + odd sinh(rt)/r), r² = γ² − ωn².
struct free_series {
  wide<double> theta_even, theta_odd, omega_even, omega_odd;
};

// What is left of a state beside each of the forced motions that `driven_linear.hpp` takes.
struct driven_start {
  free_modes beside_steady, beside_passing;
  free_series meeting_beside_steady, meeting;
};

// What is left of states, in a microsecond each: in some 190 bits, of which a hundred stay where a state has so little
// of a mode that all but the rounding error of its own digits cancels.
class driven_starts {
 public:
  explicit driven_starts(const driven_linear_constants& of)
      : driven_(of.force.re != 0 || of.force.im != 0),
        overdamped_(of.overdamped),
        damping_(words_of(of.damping)),
        frequency_squared_(words_of(of.frequency_squared)),
        first_(words_of(of.first.re)),
        second_(words_of(of.second.re)),
        steady_theta_(words_of(of.steady.re)),
        steady_omega_(words_of(many_digits(-(of.drive * of.steady.im)))),
        passing_omega_(words_of(of.passing.re)),
        inverse_(of.root == 0 ? wide<double>(0.0) : wide_of(many_digits(1 / of.root))),
        first_root_(wide_of(of.first.re)),
        second_root_(wide_of(of.second.re)) {}

  driven_start operator()(double theta, double omega) const {
    driven_start start{};
    free_motion(theta - steady_theta_, omega - steady_omega_, start.beside_steady, start.meeting_beside_steady);
    if (!driven_) return start;
    free_motion(theta, omega - passing_omega_, start.beside_passing, start.meeting);
    start.meeting.theta_odd = wide_of(omega + damping_ * theta);
    start.meeting.omega_even = omega;
    start.meeting.omega_odd = wide_of(-(damping_ * omega + frequency_squared_ * theta));
    return start;
  }

 private:
  using number = long_number<4>;
  static constexpr double largest_taken = 0x1p1000;

  // Next to resonance a steady motion can be beyond the range of doubles: then it is not asked for.
  static number words_of(many_digits x) {
    number sum(0.0);
    if (!(abs(x) < largest_taken)) return sum;
    for (int i = 0; i < 5; ++i) {
      const double head = x.convert_to<double>();
      sum = sum + number(head);
      x -= head;
    }
    return sum;
  }
  static wide<double> wide_of(const many_digits& x) { return pendula::wide_of(x); }
  static wide<double> wide_of(const number& x) {
    const double head = x.rounded();
    return {head, (x - number(head)).rounded()};
  }

  void free_motion(const number& theta, const number& omega, free_modes& modes, free_series& series) const {
    const number odd = omega + damping_ * theta, omega_odd = -(damping_ * omega + frequency_squared_ * theta);
    series = {wide_of(theta), wide_of(odd), wide_of(omega), wide_of(omega_odd)};
    if (overdamped_) {
      const wide<double> half_inverse = scaled(inverse_, 0.5);
      const wide<double> first = wide_of(omega - second_ * theta) * half_inverse;
      modes.first = {first, 0.0};
      modes.first_rate = {first * first_root_, 0.0};
      modes.second = wide_of(first_ * theta - omega) * half_inverse;
      modes.second_rate = modes.second * second_root_;
    } else {  // (θ − i (ω + γθ)/β) e^{λ1 t} and, with λ1 = −γ + iβ, its derivative
      modes.first = {series.theta_even, -(series.theta_odd * inverse_)};
      modes.first_rate = {series.omega_even, -(series.omega_odd * inverse_)};
    }
  }

  bool driven_, overdamped_;
  number damping_, frequency_squared_, first_, second_;  // γ, ωn² and the roots of an overdamped motion
  number steady_theta_, steady_omega_, passing_omega_;   // the forced motions' states at the start
  wide<double> inverse_, first_root_, second_root_;      // 1/|√(γ² − ωn²)|
};

}  // namespace pendula::inline PENDULA_MACHINE
