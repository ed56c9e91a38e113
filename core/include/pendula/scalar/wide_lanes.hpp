// Functions of lanes of wide numbers, named as those of lanes of doubles.
#pragma once

#include "pendula/scalar/machine.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <int W>
PENDULA_INLINE wide<double> lane(const wide<pack<double, W>>& x, int i) {
  return {x.hi[i], x.lo[i]};
}

// A number in every lane.
template <int W>
PENDULA_INLINE pack<double, W> spread(double x) {
  return pack<double, W>(x);
}
template <int W>
PENDULA_INLINE wide<pack<double, W>> spread(wide<double> x) {
  return {pack<double, W>(x.hi), pack<double, W>(x.lo)};
}

template <class... Numbers>
  requires(std::same_as<Numbers, wide<double>> && ...)
PENDULA_INLINE wide<pack<double, sizeof...(Numbers)>> lanes_of(Numbers... numbers) {
  return {lanes_of(numbers.hi...), lanes_of(numbers.lo...)};
}
template <int... from>
PENDULA_INLINE wide<pack<double, sizeof...(from)>> rearranged(const wide<pack<double, sizeof...(from)>>& x) {
  return {rearranged<from...>(x.hi), rearranged<from...>(x.lo)};
}

template <int W>
PENDULA_INLINE wide<pack<double, W>> times_sign_of(const wide<pack<double, W>>& x, const pack<double, W>& sign) {
  return {times_sign_of(x.hi, sign), times_sign_of(x.lo, sign)};
}
template <int W>
PENDULA_INLINE wide<pack<double, W>> operator*(const wide<pack<double, W>>& a, const wide<double>& b) {
  return a * spread<W>(b);
}

}  // namespace pendula::inline PENDULA_MACHINE
