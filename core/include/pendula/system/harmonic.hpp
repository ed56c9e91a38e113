// What swings as amplitude · cos(Ω t + φ): the torque of a drive, the acceleration of a pivot.
#pragma once

#include "pendula/scalar/product.hpp"
#include "pendula/scalar/rough_powers.hpp"
#include "pendula/scalar/sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

// The phase Ω t + φ within half a turn, with a tail: at late times its whole turns would be all that a double holds.
template <class S>
PENDULA_INLINE head_and_tail<S> phase_at(const S& frequency, const S& phase, const head_and_tail<S>& t) {
  if constexpr (carries_rounding<S>) {
    const auto [product, rest] = two_product(frequency, t.head);
    const auto [sum, of_sum] = two_sum(product, phase);
    const S turns = nearest_whole(sum * S(0x1.45f306dc9c883p-3));  // 1/2π; then 2π in two parts
    const auto [whole, of_whole] = two_product(turns, S(0x1.921fb54442d18p+2));
    const S tail = ((rest + of_sum) + frequency * t.tail) - turns * S(0x1.1a62633145c07p-52);
    return {sum - whole, tail - of_whole};
  } else {
    return {frequency * (t.head + t.tail) + phase, S(0.0)};
  }
}

// Whether a term is there at all, in any lane: one with a coefficient of zero costs nothing. A zero whose change is
// followed is there.
template <class S>
PENDULA_INLINE bool present(const S& coefficient) {
  if constexpr (requires { coefficient.changes(); }) {
    return coefficient.value != 0.0 || coefficient.changes();
  } else {
    return any_lane(mask_not(equal(rough(coefficient), roughly<S>(0.0))));
  }
}

template <class S>
struct harmonic {
  S amplitude, frequency, phase;

  // 0 where there is no amplitude.
  S frequency_squared() const {
    const roughly<S> one(1.0), zero(0.0);
    return frequency * frequency * S(choose(equal(rough(amplitude), zero), zero, one));
  }

  PENDULA_INLINE S at(const head_and_tail<S>& t) const { return amplitude * turned(t).cos; }
  PENDULA_INLINE sine_cosine<S> turned(const head_and_tail<S>& t) const {
    const auto [head, tail] = phase_at(frequency, phase, t);
    const auto [s, c] = sincos(head);
    return {s + c * tail, c - s * tail};
  }
};

// Its Taylor series, order by order: c' = −Ω s, s' = Ω c.
template <class S>
class harmonic_series {
 public:
  PENDULA_INLINE void start(const harmonic<S>& of, const head_and_tail<S>& t) {
    frequency_ = of.frequency;
    const auto [s, c] = of.turned(t);
    cosine_ = of.amplitude * c;
    sine_ = of.amplitude * s;
  }
  PENDULA_INLINE S order() const { return cosine_; }
  PENDULA_INLINE void advance(const S& inverse) {
    const S next = -(frequency_ * sine_ * inverse);
    sine_ = frequency_ * cosine_ * inverse;
    cosine_ = next;
  }

 private:
  S frequency_{0.0}, cosine_{0.0}, sine_{0.0};
};

}  // namespace pendula::inline PENDULA_MACHINE
