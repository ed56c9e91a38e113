// Logarithm and power of two to four digits, for lengths of steps: fast, and the same bits on every machine.
#pragma once

#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

// What is left of a number where few digits are enough: itself, or a double where it is made of several.
template <class S>
PENDULA_INLINE auto rough(const S& x) {
  if constexpr (has_bit_pattern<S>) {
    return x;
  } else {
    return elementary<S>::rough(x);
  }
}
template <class S>
using roughly = decltype(rough(std::declval<S>()));

// log2 |x| to 1e-4; of zero about −1023. The polynomial is the interpolant at Chebyshev's nodes.
template <class S>
PENDULA_INLINE roughly<S> rough_log2(const S& x)
  requires(!has_bit_pattern<S>)
{
  return elementary<S>::rough_log2(x);
}
template <class S>
PENDULA_INLINE S rough_log2(S x)
  requires has_bit_pattern<S>
{
  const auto pattern = bits(x) & ~sign_bit;
  const S exponent = from_bits<S>((pattern >> 52) + bits(0x1p52)) - S(0x1p52 + 1023.0);
  const S m = from_bits<S>((pattern & 0x000fffffffffffff) + bits(1.0));  // in [1, 2)
  return exponent +
         (S(-2.50561466) + m * (S(4.04961689) + m * (S(-2.09940228) + m * (S(0.63551112) + m * S(-0.08001088)))));
}

// log2 |x| to 0.05, sooner: the bits of a number follow it along a chord in each octave (Mitchell 1962, IRE Trans.
// EC-11, 512), which is below it by 0.086 at most.
template <class S>
PENDULA_INLINE S coarse_log2(S x) {
  const auto pattern = bits(x) & ~sign_bit;
  return (from_bits<S>((pattern >> 12) + bits(0x1p52)) - S(0x1p52 + (1023.0 - 0.043) * 0x1p40)) * S(0x1p-40);
}

// 2^n, exactly, of a whole number |n| ≤ 1000.
template <class S>
PENDULA_INLINE S power_of_two(S n) {
  return from_bits<S>((bits(n + S(whole_number_magic)) + 1023) << 52);
}

// For |x| ≤ 1000, to 3e-6 of the result.
template <class S>
PENDULA_INLINE S rough_exp2(S x) {
  const S n = nearest_whole(x), f = x - n;
  const S part = S(1.00000008) + f * (S(0.69312103) + f * (S(0.24022107) + f * (S(0.05592204) + f * S(0.00967604))));
  return part * power_of_two(n);
}

// The same to 1e-4, sooner: the interpolant at Chebyshev's nodes, summed in pairs.
template <class S>
PENDULA_INLINE S coarse_exp2(S x) {
  const S n = nearest_whole(x), f = x - n;
  return ((S(0.99992456) + f * S(0.69313673)) + (f * f) * (S(0.24263948) + f * S(0.05583828))) * power_of_two(n);
}

}  // namespace pendula::inline PENDULA_MACHINE
