// Two orders side by side of the series of a sine and a cosine.
#pragma once

#include "pendula/scalar/machine.hpp"
#include "pendula/system/harmonic.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Sine and cosine of two orders that follow each other, and what their products with the velocity are made of.
template <class S>
struct two_orders {
  using pair = sine_with_cosine<S>;
  using turn = typename pair::turn;
  struct velocities {
    S first, second;
  };
  struct turns {
    turn first, second;

    PENDULA_INLINE const turn& low() const { return first; }
    PENDULA_INLINE const turn& high() const { return second; }
    PENDULA_INLINE friend turns operator*(const turns& f, const velocities& w) {
      return {f.first * w.first, f.second * w.second};
    }
  };
  pair first, second;

  PENDULA_INLINE static two_orders of(const pair& a, const pair& b) { return {a, b}; }
  PENDULA_INLINE static velocities of(const S& a, const S& b) { return {a, b}; }
  PENDULA_INLINE static turns turns_of(const turn& a, const turn& b) { return {a, b}; }
  PENDULA_INLINE static two_orders twice(const pair& x) { return {x, x}; }
  PENDULA_INLINE const pair& low() const { return first; }
  PENDULA_INLINE const pair& high() const { return second; }
  PENDULA_INLINE two_orders exchanged() const { return {first.exchanged(), second.exchanged()}; }
  PENDULA_INLINE friend two_orders operator*(const two_orders& x, const S& w) { return {x.first * w, x.second * w}; }
  PENDULA_INLINE friend two_orders operator*(const two_orders& x, const velocities& w) {
    return {x.first * w.first, x.second * w.second};
  }
  PENDULA_INLINE friend two_orders operator*(const two_orders& x, const turns& f) {
    return {x.first.times(f.first), x.second.times(f.second)};
  }
  PENDULA_INLINE friend two_orders operator+(const two_orders& a, const two_orders& b) {
    return {a.first + b.first, a.second + b.second};
  }
};
// For one trajectory of doubles in four lanes: the same operations on the same numbers.
template <>
struct two_orders<double> {
  using pair = sine_with_cosine<double>;
  using turn = pair::turn;
  using four = pack<double, 4>;
  using velocities = four;
  struct turns {
    four both;

    PENDULA_INLINE turn low() const { return halves(both)[0]; }
    PENDULA_INLINE turn high() const { return halves(both)[1]; }
    PENDULA_INLINE friend turns operator*(turns f, velocities w) { return {f.both * w}; }
  };
  four both;

  PENDULA_INLINE static two_orders of(pair a, pair b) { return {joined(a.both, b.both)}; }
  PENDULA_INLINE static velocities of(double a, double b) { return joined(pack<double, 2>(a), pack<double, 2>(b)); }
  PENDULA_INLINE static turns turns_of(turn a, turn b) { return {joined(a, b)}; }
  PENDULA_INLINE static two_orders twice(const pair& x) { return {joined(x.both, x.both)}; }
  PENDULA_INLINE pair low() const { return {halves(both)[0]}; }
  PENDULA_INLINE pair high() const { return {halves(both)[1]}; }
  PENDULA_INLINE two_orders exchanged() const { return {rearranged<1, 0, 3, 2>(both)}; }
  PENDULA_INLINE friend two_orders operator*(const two_orders& x, double w) { return {x.both * four(w)}; }
  PENDULA_INLINE friend two_orders operator*(const two_orders& x, const velocities& w) { return {x.both * w}; }
  PENDULA_INLINE friend two_orders operator*(const two_orders& x, const turns& f) { return {x.both * f.both}; }
  PENDULA_INLINE friend two_orders operator+(const two_orders& a, const two_orders& b) { return {a.both + b.both}; }
};

}  // namespace pendula::inline PENDULA_MACHINE
