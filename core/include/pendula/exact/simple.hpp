// The simple pendulum in closed form, from any state, in every regime. With a = sin(θ/2), b = ω/2ωn, c = cos(θ/2) a
// motion is sin(θ/2) = k sn, ω/2ωn = k cn, cos(θ/2) = dn, k² = a² + b² (DLMF 22.19(i)), and the addition theorems
// (DLMF 22.8.1–3) carry a state on by the time t without the phase it has, and without k:
//
//     sin(θ/2) : cos(θ/2) : ω/2ωn : 1  =  a C D + b c S : c D − a b S C : b C − a c S D : c² + a² C²,
//
// with S, C, D = sn, cn, dn of ωn t. All four are sums that do not cancel, or bounded by the last. For k > 1 (rotation)
// sn(u, k) = sn(ku, 1/k)/k, cn(u, k) = dn(ku, 1/k), dn(u, k) = cn(ku, 1/k) (DLMF 22.17.2–4).
#pragma once

#include "pendula/exact/theta.hpp"
#include "pendula/scalar/arctangent.hpp"
#include "pendula/scalar/wide_sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

// The error of θ is below so many 2^-52 max(|θ|, min(1, amplitude)), that of ω so many 2^-52 of the motion's largest.
inline constexpr double exact_epsilons = 4.0;
inline constexpr double reach_of_wide = 0x1p36;  // half periods, over cancellation, up to which 98 bits of k'² will do

// What a length and a gravity give.
template <class S>
struct simple_constants {
  wide<S> frequency;            // ωn = √(g/L)
  wide<S> half_over_frequency;  // 1/2ωn
  wide<S> frequency_over_pi;

  // Of mantissas, and the power of two apart: no length or gravity is too large or too small.
  simple_constants(double length, double gravity) {
    int of_length, of_gravity;
    double near_length = std::frexp(length, &of_length), near_gravity = std::frexp(gravity, &of_gravity);
    if ((of_gravity - of_length) % 2 != 0) near_gravity *= 2.0, of_gravity -= 1;
    const wide<double> root = square_root(wide<double>(near_gravity) / wide<double>(near_length));
    const int power = (of_gravity - of_length) / 2;
    frequency = broadcast(root, power);
    half_over_frequency = broadcast(wide<double>(0.5) / root, -power);
    frequency_over_pi = broadcast(root * wide_pi<double>::inverse(), power);
  }

 private:
  static wide<S> broadcast(wide<double> x, int power) {
    return {S(std::ldexp(x.hi, power)), S(std::ldexp(x.lo, power))};
  }
};

// A state as the closed form takes it.
template <class S>
struct simple_start {
  S theta, omega;       // as given
  S turns;              // whole turns before the state's own
  S a, b, c;            // in its own turn: sin(θ/2), ω/2ωn and cos(θ/2) ≥ 0
  wide<S> c2;           // c²
  wide<S> complement;   // κ' = √(1 − κ²) of κ = k or, in rotation, 1/k
  S half_inverse;       // 1/2κ'
  wide<S> stretch;      // 1 or, in rotation, k
  S rotating;           // 1 in rotation, else 0
  S spread, cancelled;  // |k'²| and the sizes of what it is the difference of: they decide up to when digits are enough
  // Half periods in a second, with a tail, where more digits are needed than a wide number has; else 0.
  wide<S> rate{S(0.0), S(0.0)};
  S rate_tail{0.0};

  PENDULA_INLINE simple_start(S angle, S speed) : theta(angle), omega(speed) {}
};

namespace detail {

// Takes the whole turns off: the sine of half the rest, |θ/2| ≤ π/2, and its cosine, which is returned.
template <class S>
PENDULA_INLINE wide<S> take_turns_off(simple_start<S>& y) {
  const auto [sine, cosine] = wide_sincos(S(0.5) * y.theta);
  y.turns = nearest_whole(y.theta * S(0x1.45f306dc9c883p-3));  // 1/2π
  const S parity = parity_sign(y.turns);
  const auto beyond = less(cosine.hi * parity, S(0.0));  // the top lies between the state and that turn
  const S sign = parity * choose(beyond, S(-1.0), S(1.0));
  y.turns = y.turns + choose(beyond, times_sign_of(S(1.0), sine.hi * parity), S(0.0));
  y.a = rounded(sine) * sign;
  return scaled(cosine, sign);
}

}  // namespace detail

// From doubles, in `wide` numbers: enough up to some time. Beyond: many_digits.hpp.
template <class S>
PENDULA_INLINE simple_start<S> start_of(const simple_constants<S>& constants, S theta, S omega) {
  simple_start<S> y(theta, omega);
  const wide<S> c = detail::take_turns_off(y), b = constants.half_over_frequency * omega, b2 = square(b);
  y.b = constants.half_over_frequency.hi * omega + constants.half_over_frequency.lo * omega;
  y.c = rounded(c);
  y.c2 = square(c);
  const wide<S> difference = settled(quick_sum(y.c2, -b2));
  const wide<S> size = scaled(difference, times_sign_of(S(1.0), difference.hi));
  const auto rotating = less(difference.hi, S(0.0)), separatrix = equal(difference.hi, S(0.0));
  y.rotating = choose(rotating, S(1.0), S(0.0));
  y.stretch = wide<S>(1.0);
  wide<S> complement2 = choose(separatrix, wide<S>(1.0), size);
  if (any_lane(rotating)) {
    const wide<S> k2 = quick_sum(wide<S>(1.0), -difference);
    complement2 = choose(rotating, size / k2, complement2);
    y.stretch = choose(rotating, square_root(k2), y.stretch);
  }
  const auto [root, half_inverse] = square_root_by(complement2, S(0.5) / complement2.hi);
  y.complement = choose(separatrix, wide<S>(0.0), root);
  y.half_inverse = half_inverse;
  // beyond what cancels in the difference: angles that the sine has no digits for, and overflow
  const auto usual = mask_and(less(magnitude(theta), S(largest_wide_angle)), less(b2.hi, S(0x1p900)));
  y.spread = choose(usual, size.hi, S(0.0));
  y.cancelled = size.hi + b2.hi;
  return y;
}

template <class S>
class simple_motion {
 public:
  using mask = decltype(less(S(0.0), S(0.0)));
  struct point {
    S theta, omega;
    mask digits_enough;
  };

  PENDULA_INLINE simple_motion(const simple_constants<S>& constants, const simple_start<S>& start)
      : start_(start),
        theta_(start.complement, start.half_inverse),
        a2_(sum_with_smaller(wide<S>(1.0), -start.c2)),
        twice_frequency_(S(2.0) * constants.frequency.hi),
        bc_(start.b * start.c),
        ab_(start.a * start.b),
        ac_(start.a * start.c),
        rotating_(less(S(0.0), start.rotating)) {
    wide<S> rate = constants.frequency_over_pi * theta_.mean;  // ωn/2K
    if (any_lane(rotating_)) {
      inverse_stretch_ = wide<S>(1.0) / start.stretch;
      rate = rate * start.stretch;
    }
    rate_ = choose(equal(start.rate.hi, S(0.0)), rate, start.rate);
  }

  // After the time t.
  PENDULA_INLINE point at(wide<S> t) const {
    const auto [half_periods, rest] = phase(t);
    const point there = at_phase(half_periods, parity_sign(half_periods), rest);
    const auto moved = mask_not(equal(t.hi, S(0.0)));
    return {choose(moved, there.theta, start_.theta), choose(moved, there.omega, start_.omega), there.digits_enough};
  }

  // After so many half periods, an even (1) or odd (−1) whole number of them, and the rest of one.
  PENDULA_INLINE point at_phase(S half_periods, S evenness, wide<S> rest) const {
    auto [s, c, d, w] = theta_(rest);
    const S parity = choose(rotating_, S(1.0), evenness);
    s = scaled(s, parity), c = scaled(c, parity);
    if (any_lane(rotating_)) {
      const wide<S> dn = d;
      d = choose(rotating_, c, d);
      c = choose(rotating_, dn, c);
      s = choose(rotating_, s * inverse_stretch_, s);
    }
    const S s1 = rounded(s), c1 = rounded(c), d1 = rounded(d), w1 = rounded(w);
    const S sine = start_.a * (c1 * d1) + bc_ * (s1 * w1), cosine = start_.c * (d1 * w1) - ab_ * (s1 * c1);
    const S speed = start_.b * (c1 * w1) - ac_ * (s1 * d1);
    const S divisor = rounded(quick_sum(start_.c2 * wide<S>(two_product(w1, w1)), a2_ * wide<S>(two_product(c1, c1))));
    const S angle = angle_of(sine, cosine);
    return {unwrapped(angle, half_periods, rest.hi), twice_frequency_ * speed / divisor + S(0.0),  // at rest not −0
            good(half_periods)};
  }

  S half_periods(S t) const { return magnitude(t * rate_.hi); }
  // Of a libration, or of one turn of a rotation.
  S period() const {
    const auto separatrix = equal(start_.complement.hi, S(0.0));
    return choose(separatrix, S(INFINITY), choose(rotating_, S(1.0), S(2.0)) * rounded(wide<S>(1.0) / rate_));
  }

 private:
  struct reduced {
    S whole;
    wide<S> rest;
  };

  // Half periods in t, the nearest whole number and the rest, which keeps its digits where it is small.
  PENDULA_INLINE reduced phase(wide<S> t) const {
    const auto [product, product_tail] = two_product(t.hi, rate_.hi);
    const S whole = nearest_whole(product);
    const S small = t.hi * rate_.lo + (t.lo * rate_.hi + t.hi * start_.rate_tail);
    const auto [rest, rest_tail] = two_sum(product - whole, product_tail);
    return {whole, wide<S>(two_sum(rest, rest_tail + small))};
  }

  PENDULA_INLINE mask good(S half_periods) const {
    return less((magnitude(half_periods) + S(1.0)) * start_.cancelled, S(reach_of_wide) * start_.spread);
  }

  // Twice the angle and the turns. Within half a turn of time forwards from [−π/2, π/2] the half angle reaches π and no
  // −π, but for its rounding.
  PENDULA_INLINE S unwrapped(S angle, S half_periods, S rest) const {
    const S forwards = times_sign_of(S(1.0), start_.b), onwards = times_sign_of(forwards, rest);
    const auto fallen = mask_and(rotating_, less(angle * onwards, S(-2.0)));
    const S turns =
        start_.turns + choose(rotating_, forwards * half_periods, S(0.0)) + choose(fallen, S(2.0) * onwards, S(0.0));
    const wide<S> turned = scaled(wide_pi<S>::value(), S(2.0)) * turns;
    return turned.hi + (turned.lo + S(2.0) * angle);
  }

  simple_start<S> start_;
  jacobi_theta<S> theta_;
  wide<S> rate_, a2_, inverse_stretch_{S(1.0), S(0.0)};
  S twice_frequency_, bc_, ab_, ac_;
  mask rotating_;
};

}  // namespace pendula::inline PENDULA_MACHINE
