// The exponential of a number that is not positive, and its distance from 1.
#pragma once

#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
struct exponential_values {
  wide<S> value;      // e^x
  wide<S> minus_one;  // e^x − 1, which keeps its digits for small x
};

// For x ≤ 0 given as head and tail, to about 2^-55 of the result; below −708 as for −708, where e^x is no longer a
// normal number.
template <class S>
PENDULA_INLINE exponential_values<S> exponential(wide<S> x) {
  const auto tiny = less(x.hi, S(-708.0));
  const S head = choose(tiny, S(-708.0), x.hi), tail = choose(tiny, S(0.0), x.lo);
  const S n = nearest_whole(head * S(0x1.71547652b82fep+0));  // 1/ln 2
  // ln 2 in parts of 41 and 53 bits (Cody & Waite 1980): n times the first is exact
  const S near = head - n * S(0x1.62e42fefa3000p-1);
  const auto [r, r_tail] = fast_two_sum(near, tail - n * S(0x1.3de6af278ece6p-42));
  // (e^r − 1 − r)/r² for |r| ≤ ln(2)/2, by the power series: the first term left out is below 2^-58
  const S v = r * r, w = v * v;
  const S low = (S(1.0 / 2.0) + r * S(1.0 / 6.0)) + v * (S(1.0 / 24.0) + r * S(1.0 / 120.0));
  const S middle = (S(1.0 / 720.0) + r * S(1.0 / 5040.0)) + v * (S(1.0 / 40320.0) + r * S(1.0 / 362880.0));
  const S high =
      (S(1.0 / 3628800.0) + r * S(1.0 / 39916800.0)) + v * (S(1.0 / 479001600.0) + r * S(1.0 / 6227020800.0));
  const auto [p, p_tail] = fast_two_sum(r, v * (low + w * (middle + w * high)) + r_tail);
  const S power = from_bits<S>((bits(n + S(whole_number_magic)) + 1023) << 52);  // 2^n
  const auto [below, below_tail] = two_sum(power - S(1.0), power * p);
  const auto [above, above_tail] = fast_two_sum(power, power * p);
  return {{above, above_tail + power * p_tail}, wide<S>(fast_two_sum(below, below_tail + power * p_tail))};
}

}  // namespace pendula::inline PENDULA_MACHINE
