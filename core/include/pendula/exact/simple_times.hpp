// Period, action, and when an angle is passed, of the linear and the simple pendulum.
#pragma once

#include <boost/math/special_functions/ellint_rf.hpp>

#include "pendula/exact/elliptic.hpp"
#include "pendula/exact/simple_many_digits.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Of a libration, or of one turn of a rotation; infinite on the separatrix.
inline double simple_period(double length, double gravity, double theta, double omega) {
  const simple_constants<double> constants(length, gravity);
  simple_motion<double> motion(constants, start_of(constants, theta, omega));
  if (!motion.at(wide<double>(0.0)).digits_enough)
    motion = simple_motion<double>(constants, start_of_many_digits(length, gravity, theta, omega).start);
  return motion.period();
}

// ∮ p dθ / 2π = (8/π) m √(g L³) (E − k'² K) in libration, (4/π) m √(g L³) k E(1/k) in rotation: with DLMF 22.19(i) and
// 19.2.8. On the separatrix half of a rotation's is all of a libration's.
inline double simple_action(double length, double gravity, double mass, double theta, double omega) {
  const simple_start<double> y = start_of_many_digits(length, gravity, theta, omega).start;
  const wide<double> scale = wide<double>(mass) * wide<double>(length) * square_root(wide<double>(gravity) * length) *
                             wide_pi<double>::inverse();
  const wide<double> k = y.rotating > 0.0 ? wide<double>(1.0) / y.stretch : wide<double>(std::hypot(y.a, y.b));
  const modulus<double> m{k, y.complement, wide<double>(1.0), k.hi, false};
  if (y.rotating > 0.0) return rounded(scaled(scale, 4.0) * y.stretch * complete_E(m));
  return rounded(scaled(scale, 8.0) * square(k) * complete_B(m));
}

namespace detail {

// F(φ, k) for any φ, which counts half turns: DLMF 19.2.10 and, by Carlson's integral, 19.25.5.
inline many_digits incomplete_F_of(const many_digits& phi, const many_digits& k2, const many_digits& K) {
  const many_digits& pi = pi_in_many_digits();
  const many_digits n = round(phi / pi), s = sin(many_digits(phi - n * pi)), s2 = s * s;
  const many_digits part = s * boost::math::ellint_rf(many_digits(1 - s2), many_digits(1 - k2 * s2), many_digits(1));
  return n == 0 ? part : many_digits(part + 2 * n * K);
}

// From the phase u0 on, with the period 2 half: when it is first at u or at half − u.
inline many_digits first_passage(const many_digits& u0, const many_digits& u, const many_digits& half) {
  many_digits best = -1;
  for (const many_digits& target : {u, many_digits(half - u)}) {
    many_digits wait = target - u0;
    wait -= 2 * half * floor(many_digits(wait / (2 * half)));
    if (best < 0 || wait < best) best = wait;
  }
  return best;
}

inline many_digits complete_K_of(const many_digits& k2) {
  return pi_in_many_digits() / (2 * mean_in_many_digits(1, sqrt(many_digits(1 - k2))));
}

}  // namespace detail

// The first time after 0 at which the angle is `target`; infinite where it never is.
inline double simple_time_at(double length, double gravity, double theta, double omega, double target) {
  if (target == theta) return 0.0;
  const many_digits& pi = pi_in_many_digits();
  const many_digits frequency = natural_frequency_in_many_digits(length, gravity), turns = round(theta / (2 * pi));
  const many_digits half = theta / many_digits(2) - turns * pi, wanted = target / many_digits(2) - turns * pi;
  const many_digits a = sin(half), b = omega / (2 * frequency), k2 = a * a + b * b, k = sqrt(k2);
  const int forwards = omega < 0.0 ? -1 : 1;
  const bool within = abs(wanted) < pi / 2;
  many_digits wait;
  if (k2 < 1) {
    const many_digits ratio = k2 == 0 ? many_digits(2) : many_digits(sin(wanted) / k);
    if (!within || abs(ratio) > 1) return INFINITY;
    const many_digits K = detail::complete_K_of(k2);
    const auto phase = [&](const many_digits& s) { return detail::incomplete_F_of(asin(s), k2, K); };
    const many_digits up = phase(omega == 0.0 ? many_digits(a < 0 ? -1 : 1) : many_digits(a / k));
    wait = detail::first_passage(omega < 0.0 ? many_digits(2 * K - up) : up, phase(ratio), 2 * K) / frequency;
  } else if ((wanted - half) * forwards < 0 || (k2 == 1 && !within)) {
    return INFINITY;
  } else if (k2 == 1) {  // u = gd⁻¹(θ/2) = artanh sin(θ/2), DLMF 4.23.42
    wait = (atanh(sin(wanted)) - atanh(a)) * forwards / frequency;
  } else {
    const many_digits K = detail::complete_K_of(1 / k2);
    wait = (detail::incomplete_F_of(wanted, 1 / k2, K) - detail::incomplete_F_of(half, 1 / k2, K)) * forwards /
           (k * frequency);
  }
  return wait.convert_to<double>();
}

// The same of the linear pendulum, θ = R sin(ωn t + φ0).
inline double linear_time_at(double length, double gravity, double theta, double omega, double target) {
  if (target == theta) return 0.0;
  const many_digits frequency = natural_frequency_in_many_digits(length, gravity);
  const many_digits b = omega / frequency, R = sqrt(many_digits(theta) * theta + b * b);
  if (R < std::fabs(target)) return INFINITY;
  const many_digits phase = atan2(many_digits(theta), b);
  const many_digits wait = detail::first_passage(phase, asin(many_digits(target / R)), pi_in_many_digits());
  return many_digits(wait / frequency).convert_to<double>();
}

}  // namespace pendula::inline PENDULA_MACHINE
