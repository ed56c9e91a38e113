// Sine and cosine of π r.
#pragma once

#include "pendula/scalar/sincos.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
struct wide_pi {
  static wide<S> value() { return {S(0x1.921fb54442d18p+1), S(0x1.1a62633145c07p-53)}; }
  static wide<S> inverse() { return {S(0x1.45f306dc9c883p-2), S(-0x1.6b01ec5417056p-56)}; }
};

// For |r| ≤ 1/2. Both keep their digits where they are small: beyond 1/4 they exchange, with 1/2 − r exactly.
template <class S>
PENDULA_INLINE sine_cosine<S> sincos_of_half_turns(wide<S> r) {
  const S sign = times_sign_of(S(1.0), r.hi);
  const wide<S> size = scaled(r, sign), rest = sum_with_smaller(wide<S>(0.5), -size);
  const auto beyond = less(S(0.25), size.hi);
  const wide<S> x = wide_pi<S>::value() * choose(beyond, rest, size);
  const S z = x.hi * x.hi;
  const auto [sine, cosine] = sincos_remainders(x.hi, z);
  const S s = x.hi + (sine + x.lo), c = S(1.0) - ((S(0.5) * z - cosine) + x.hi * x.lo);
  return {choose(beyond, c, s) * sign, choose(beyond, s, c)};
}

}  // namespace pendula::inline PENDULA_MACHINE
