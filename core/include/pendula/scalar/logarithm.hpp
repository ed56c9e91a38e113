// The natural logarithm, the same bits on every machine.
#pragma once

#include "pendula/scalar/choose.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Of a normal positive number, to about one unit in the last place: ln(2^n m) with m within √½ and √2 by
// ln m = 2 artanh((m − 1)/(m + 1)) (DLMF 4.6.6).
template <class S>
PENDULA_INLINE S logarithm(S x) {
  const auto pattern = bits(x);
  S n = from_bits<S>((pattern >> 52) + bits(S(0x1p52))) - S(0x1p52 + 1023.0);
  S m = from_bits<S>((pattern & 0x000fffffffffffff) + bits(S(1.0)));  // in [1, 2)
  const auto large = less(S(0x1.6a09e667f3bcdp+0), m);
  m = choose(large, m * S(0.5), m);
  n = choose(large, n + S(1.0), n);
  const S f = m - S(1.0), s = f / (m + S(1.0)), z = s * s, w = z * z;
  const S even = S(1.0 / 5.0) + w * (S(1.0 / 9.0) + w * (S(1.0 / 13.0) + w * (S(1.0 / 17.0) + w * S(1.0 / 21.0))));
  const S odd = S(1.0 / 3.0) + w * (S(1.0 / 7.0) + w * (S(1.0 / 11.0) + w * (S(1.0 / 15.0) + w * S(1.0 / 19.0))));
  // f − s (f − 2 z (…)) keeps the digits of f, which is exact
  const S rest = s * (f - S(2.0) * (z * odd + w * even));
  // ln 2 in parts of 41 and 53 bits (Cody & Waite 1980): n times the first is exact
  return n * S(0x1.62e42fefa3000p-1) + (f - (rest - n * S(0x1.3de6af278ece6p-42)));
}

}  // namespace pendula::inline PENDULA_MACHINE
