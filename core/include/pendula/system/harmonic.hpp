// What swings as amplitude · cos(Ω t + φ): the torque of a drive, the acceleration of a pivot.
#pragma once

#include "pendula/scalar/machine.hpp"
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

// A sine and a cosine, of any scalar and, of one trajectory of doubles, in two lanes: the same operations on the same
// numbers.
template <class S>
struct sine_with_cosine {
  S sine, cosine;

  PENDULA_INLINE S first() const { return sine; }
  PENDULA_INLINE S second() const { return cosine; }
  PENDULA_INLINE static sine_with_cosine of(const S& s, const S& c) { return {s, c}; }
  PENDULA_INLINE friend sine_with_cosine operator+(const sine_with_cosine& a, const sine_with_cosine& b) {
    return {a.sine + b.sine, a.cosine + b.cosine};
  }
  PENDULA_INLINE friend sine_with_cosine operator*(const sine_with_cosine& a, const S& b) {
    return {a.sine * b, a.cosine * b};
  }
  // By a quarter turn, and times a factor: sin → cos, cos → −sin; as an exchange, which can go before, and a product.
  using turn = S;
  PENDULA_INLINE static turn factor(const S& x) { return x; }
  PENDULA_INLINE sine_with_cosine turned(const turn& by) const { return exchanged().times(by); }
  PENDULA_INLINE sine_with_cosine exchanged() const { return {cosine, sine}; }
  PENDULA_INLINE sine_with_cosine times(const turn& by) const { return {sine * by, cosine * -by}; }
};
template <>
struct sine_with_cosine<double> {
  pack<double, 2> both;

  PENDULA_INLINE double first() const { return both[0]; }
  PENDULA_INLINE double second() const { return both[1]; }
  PENDULA_INLINE static sine_with_cosine of(double s, double c) { return {lanes_of(s, c)}; }
  PENDULA_INLINE friend sine_with_cosine operator+(sine_with_cosine a, sine_with_cosine b) { return {a.both + b.both}; }
  PENDULA_INLINE friend sine_with_cosine operator*(sine_with_cosine a, double b) {
    return {a.both * pack<double, 2>(b)};
  }
  using turn = pack<double, 2>;
  PENDULA_INLINE static turn factor(double x) { return lanes_of(x, -x); }
  PENDULA_INLINE sine_with_cosine turned(turn by) const { return exchanged().times(by); }
  PENDULA_INLINE sine_with_cosine exchanged() const { return {rearranged<1, 0>(both)}; }
  PENDULA_INLINE sine_with_cosine times(turn by) const { return {both * by}; }
};

// Its Taylor series, order by order: c' = −Ω s, s' = Ω c.
template <class S>
class harmonic_series {
 public:
  PENDULA_INLINE void start(const harmonic<S>& of, const head_and_tail<S>& t) {
    frequency_ = of.frequency;
    const auto [s, c] = of.turned(t);
    now_ = pair::of(of.amplitude * s, of.amplitude * c);
  }
  PENDULA_INLINE S order() const { return now_.second(); }
  PENDULA_INLINE void advance(const typename sine_with_cosine<S>::turn& inverse) {
    now_ = now_.turned(inverse * frequency_);
  }

 private:
  using pair = sine_with_cosine<S>;

  S frequency_{0.0};
  pair now_ = pair::of(S(0.0), S(0.0));
};

}  // namespace pendula::inline PENDULA_MACHINE
