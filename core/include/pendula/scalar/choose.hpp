// Choices between lanes without branches.
#pragma once

#include <cmath>

#include "pendula/scalar/pack.hpp"

namespace pendula::inline PENDULA_MACHINE {

PENDULA_INLINE bool mask_and(bool a, bool b) { return a && b; }
template <LaneMask M>
PENDULA_INLINE M mask_and(M a, M b) {
  return a & b;
}

PENDULA_INLINE bool mask_or(bool a, bool b) { return a || b; }
template <LaneMask M>
PENDULA_INLINE M mask_or(M a, M b) {
  return a | b;
}

PENDULA_INLINE bool mask_not(bool a) { return !a; }
template <LaneMask M>
PENDULA_INLINE M mask_not(M a) {
  return ~a;
}

template <class M>
PENDULA_INLINE bool any_lane(M mask) {
  return !all_lanes(mask_not(mask));
}

inline constexpr std::int64_t sign_bit = std::numeric_limits<std::int64_t>::min();

template <class S>
PENDULA_INLINE S magnitude(S x) {
  return from_bits<S>(bits(x) & ~sign_bit);
}
// |x| with the sign of x turned where `sign` is negative.
template <class S>
PENDULA_INLINE S times_sign_of(S x, S sign) {
  return from_bits<S>(bits(x) ^ (bits(sign) & sign_bit));
}

// Adding 1.5·2^52 to a number below 2^51 leaves the nearest whole number, and its parity in the lowest bit.
inline constexpr double whole_number_magic = 0x1.8p52;

template <class S>
PENDULA_INLINE S nearest_whole(S x) {
  return (x + S(whole_number_magic)) - S(whole_number_magic);
}
// 1 for an even whole number, −1 for an odd one.
template <class S>
PENDULA_INLINE S parity_sign(S whole) {
  return from_bits<S>(bits(S(1.0)) | (bits(whole + S(whole_number_magic)) << 63));
}

}  // namespace pendula::inline PENDULA_MACHINE
