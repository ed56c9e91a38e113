// The linear pendulum with viscous friction and a drive, in closed form.
//
// θ̈ + 2γ θ̇ + ωn² θ = f cos(Ωt + φ) is solved by divided differences of the exponential at the roots λ1, λ2 of the
// characteristic polynomial and at iΩ (McCurdy, Ng & Parlett 1984, Math. Comp. 43, 501; Higham 2008, Functions of
// Matrices, B.16): the impulse response is exp[λ1, λ2](t), the motion forced from rest Re(F exp[λ1, λ2, iΩ](t)). They
// are smooth where nodes meet, at critical damping and at resonance; their quotients are not. So a motion is one that
// the drive forces, of three, and the free motion from what is left of the state beside it:
//
//   nodes all apart       steady, F e^{iΩt}/((iΩ − λ1)(iΩ − λ2))
//   iΩ next to λ1         passing, F/(iΩ − λ2) exp[λ1, iΩ](t): from the angle 0
//   all next to another   from rest, F exp[λ1, λ2, iΩ](t), by its power series
//
// and the free motion is that of two modes, or of e^{−γt} cosh and sinh where λ1 is next to λ2. Next means nearer than
// 2^-10/|t|: all quotients together lose 21 bits at most, of about 98, and power series have few terms.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "pendula/exact/driven_linear_setup.hpp"
#include "pendula/scalar/wide_exponential.hpp"

namespace pendula::inline PENDULA_MACHINE {

// What all motions of a driven pendulum from the same start of time share at a time.
struct driven_instant {
  bool counted;                   // whether the digits of the phases reach so far
  bool roots_meet, drive_meets;   // with λ1
  wide<double> theta, omega;      // the forced motion
  wide_complex first;             // e^{λ1 t}; where roots meet, e^{−γt} cosh(rt) and e^{−γt} sinh(rt)/r
  wide<double> second;            // e^{λ2 t} of an overdamped one
  int first_power, second_power;  // of two, which belong to them
};

struct driven_point {
  double theta, omega;
};

namespace detail {

inline constexpr double next_nodes = 0x1p-10;
inline constexpr double counted_half_turns = 0x1p50;
inline constexpr int series_terms = 8;  // for |z| < 1.5 · 2^-10: the first left out is below 2^-93 of the first

// (e^z − 1)/z
inline wide_complex exponential_quotient(wide_complex z) {
  wide_complex sum{over_factorial(series_terms), 0.0};
  for (int k = series_terms - 1; k > 0; --k) sum = z * sum + over_factorial(k);
  return sum;
}

// exp[x, −x, z] and exp[x, −x] + z exp[x, −x, z], its derivative by a factor of all: Σ h_k/(k + 2)! and Σ h_k/(k + 1)!
// with the complete homogeneous symmetric polynomials h_k of the nodes (McCurdy, Ng & Parlett 1984).
struct second_difference {
  wide_complex value, slope;
};
inline second_difference second_difference_of(wide<double> x_squared, wide_complex z) {
  wide_complex h{1.0, 0.0}, value{over_factorial(2), 0.0}, slope{1.0, 0.0};
  wide<double> power(1.0);
  for (int k = 1; k < series_terms; ++k) {
    h = h * z;
    if (k % 2 == 0) h.re = h.re + (power = power * x_squared);
    value = value + h * over_factorial(k + 2);
    slope = slope + h * over_factorial(k + 1);
  }
  return {value, slope};
}

// cosh x and sinh(x)/x
inline wide_complex even_and_odd(wide<double> x_squared) {
  wide_complex sum{over_factorial(8), over_factorial(9)};
  for (int k = 6; k >= 0; k -= 2) sum = sum * x_squared + wide_complex{over_factorial(k), over_factorial(k + 1)};
  return sum;
}

// The sum of a, b and c with powers of two, of which the largest is left to the end.
inline double sum_of_scaled(wide<double> a, int of_a, wide<double> b, int of_b, wide<double> c) {
  int top = std::numeric_limits<int>::min();
  if (a.hi != 0.0) top = of_a;
  if (b.hi != 0.0) top = std::max(top, of_b);
  if (c.hi != 0.0) top = std::max(top, 0);
  if (top == std::numeric_limits<int>::min()) return 0.0;
  const auto part = [top](wide<double> x, int power) {
    if (x.hi == 0.0 || power < top - 1000) return wide<double>(0.0);
    return scaled(x, from_bits<double>(static_cast<std::int64_t>(1023 + power - top) << 52));
  };
  const double sum = rounded((part(a, of_a) + part(b, of_b)) + part(c, 0));
  return top == 0 ? sum : std::ldexp(sum, top);
}

}  // namespace detail

class driven_linear {
 public:
  // Every state that is given belongs to the time t0.
  driven_linear(const driven_linear_parameters& of, double t0)
      : driven_linear(driven_linear_constants(of, t0), t0, of.torque != 0.0) {}

  driven_start start(double theta, double omega) const { return starts_(theta, omega); }

  driven_instant instant(double t) const {
    const wide<double> elapsed(two_sum(t, -t0_));
    const double size = std::fabs(elapsed.hi);
    driven_instant now{};
    now.counted = size * std::max(own_rate_.head, drive_rate_.head) < detail::counted_half_turns;
    if (!now.counted) return now;
    now.roots_meet = size * between_roots_ < detail::next_nodes;
    now.drive_meets = driven_ && size * to_drive_size_ < detail::next_nodes;
    if (now.roots_meet) {
      const wide<double> x_squared = discriminant_ * elapsed * elapsed;
      const auto [mantissa, power] = wide_exponential(-(damping_ * elapsed));
      const wide_complex both = detail::even_and_odd(x_squared);
      now.first = wide_complex{both.re, both.im * elapsed} * mantissa;
      now.first_power = power;
      if (now.drive_meets) force_from_rest(now, elapsed, x_squared, mantissa, power);
    } else {
      set_modes(now, elapsed);
      if (now.drive_meets) force_passing(now, elapsed);
    }
    if (driven_ && !now.drive_meets) {
      const wide_complex direction = turned(drive_rate_, elapsed);
      now.theta = real_product(steady_, direction);
      now.omega = real_product(steady_rate_, direction);
    }
    return now;
  }

 private:
  driven_linear(const driven_linear_constants& of, double t0, bool driven)
      : starts_(of),
        t0_(t0),
        driven_(driven),
        overdamped_(of.overdamped),
        damping_(wide_of(of.damping)),
        discriminant_(wide_of(of.discriminant)),
        first_(detail::wide_of(of.first)),
        second_(wide_of(of.second.re)),
        to_drive_(detail::wide_of(of.from_first_to_drive())),
        above_centre_{damping_, wide_of(of.drive)},
        force_(detail::wide_of(of.force)),
        passing_(detail::wide_of(of.passing)),
        steady_(detail::wide_of(of.steady)),
        steady_rate_(detail::wide_of(of.steady * detail::many_complex{0, of.drive})),
        between_roots_(2.0 * of.root.convert_to<double>()),
        to_drive_size_(detail::size_of(of.from_first_to_drive())),
        own_rate_(words_of(overdamped_ ? many_digits(0) : many_digits(of.root / pi_in_many_digits()))),
        drive_rate_(words_of(driven_ ? many_digits(of.drive / pi_in_many_digits()) : many_digits(0))) {}

  static wide_complex turned(const three_words& rate, wide<double> elapsed) {
    return direction_after({rate.head, rate.middle, rate.tail}, elapsed);
  }

  void set_modes(driven_instant& now, wide<double> elapsed) const {
    const auto [mantissa, power] = wide_exponential(first_.re * elapsed);
    now.first_power = power;
    if (overdamped_) {
      now.first = {mantissa, 0.0};
      const auto [other, other_power] = wide_exponential(second_ * elapsed);
      now.second = other;
      now.second_power = other_power;
    } else {
      now.first = turned(own_rate_, elapsed) * mantissa;
    }
  }

  // λ1 t is next to iΩt: its real part is small, and so is the power.
  void force_passing(driven_instant& now, wide<double> elapsed) const {
    const wide_complex z = to_drive_ * elapsed, quotient = detail::exponential_quotient(z);
    const wide_complex first = now.first * wide<double>(std::ldexp(1.0, now.first_power));
    const wide_complex difference = first * quotient * elapsed;
    now.theta = real_product(passing_, difference);
    now.omega = real_product(passing_, first_ * difference + first * (z * quotient + wide<double>(1.0)));
  }

  void force_from_rest(driven_instant& now, wide<double> elapsed, wide<double> x_squared, wide<double> mantissa,
                       int power) const {
    const auto [value, slope] = detail::second_difference_of(x_squared, above_centre_ * elapsed);
    const wide<double> scale = mantissa * std::ldexp(1.0, power) * elapsed;
    now.theta = real_product(force_, value * elapsed) * scale;
    now.omega = real_product(force_, slope + value * -(damping_ * elapsed)) * scale;
  }

  driven_starts starts_;
  double t0_;
  bool driven_, overdamped_;
  wide<double> damping_, discriminant_;
  wide_complex first_;
  wide<double> second_;
  wide_complex to_drive_, above_centre_;  // iΩ − λ1, iΩ + γ
  wide_complex force_, passing_, steady_, steady_rate_;
  double between_roots_, to_drive_size_;  // |λ1 − λ2|, |iΩ − λ1|
  three_words own_rate_, drive_rate_;     // half turns in a second
};

// NaN where the phases are beyond 2^50 half turns.
inline driven_point point_of(const driven_start& start, const driven_instant& now) {
  if (!now.counted) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  wide<double> theta, omega, second(0.0), second_rate(0.0);
  if (now.roots_meet) {
    const free_series& free = now.drive_meets ? start.meeting : start.meeting_beside_steady;
    theta = free.theta_even * now.first.re + free.theta_odd * now.first.im;
    omega = free.omega_even * now.first.re + free.omega_odd * now.first.im;
  } else {
    const free_modes& free = now.drive_meets ? start.beside_passing : start.beside_steady;
    theta = real_product(free.first, now.first);
    omega = real_product(free.first_rate, now.first);
    second = free.second * now.second;
    second_rate = free.second_rate * now.second;
  }
  return {detail::sum_of_scaled(theta, now.first_power, second, now.second_power, now.theta),
          detail::sum_of_scaled(omega, now.first_power, second_rate, now.second_power, now.omega)};
}

class driven_linear_motion {
 public:
  driven_linear_motion(const driven_linear_parameters& of, double theta, double omega, double t0)
      : system_(of, t0), start_(system_.start(theta, omega)) {}

  driven_point at(double t) const { return point_of(start_, system_.instant(t)); }

 private:
  driven_linear system_;
  driven_start start_;
};

// Points (state_count, time_count, 2) of states (θ, ω) at t0, at times: what times share is worked out once for some
// hundred states, what a state's points share once for some hundred times. `go_on` is asked now and then whether to;
// false where it was not.
template <class GoOn>
bool driven_linear_points(const driven_linear& system, const double* states, std::size_t state_count,
                          const double* times, std::size_t time_count, double* out, GoOn&& go_on) {
  constexpr std::size_t block = 256;
  std::vector<driven_start> starts;
  std::vector<driven_instant> instants;
  for (std::size_t i0 = 0; i0 < state_count; i0 += block) {
    starts.clear();
    for (std::size_t i = i0; i < std::min(i0 + block, state_count); ++i)
      starts.push_back(system.start(states[2 * i], states[2 * i + 1]));
    for (std::size_t j0 = 0; j0 < time_count; j0 += block) {
      if (!go_on()) return false;
      instants.clear();
      for (std::size_t j = j0; j < std::min(j0 + block, time_count); ++j) instants.push_back(system.instant(times[j]));
      for (std::size_t i = 0; i < starts.size(); ++i)
        for (std::size_t j = 0; j < instants.size(); ++j) {
          const auto [theta, omega] = point_of(starts[i], instants[j]);
          double* const to = out + 2 * ((i0 + i) * time_count + j0 + j);
          to[0] = theta;
          to[1] = omega;
        }
    }
  }
  return true;
}

}  // namespace pendula::inline PENDULA_MACHINE
