// A number of some hundred decimal digits, for what a wide one has too few of: the phase after very many periods, the
// neighbourhood of a separatrix, angles of many turns. It computes with integers, so its bits are the same on every
// machine, and it takes about a thousand times as long as a double.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

// 10^±646000000 lies within its range, so that squares of the smallest doubles do.
using many_digits =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;

// The sum of three doubles, each about the rounding error of the one before: 159 bits.
struct three_words {
  double head, middle, tail;
};

inline many_digits many_digits_of(wide<double> x) { return many_digits(x.hi) + x.lo; }

inline three_words words_of(many_digits x) {
  three_words words{};
  words.head = x.convert_to<double>();
  x -= words.head;
  words.middle = x.convert_to<double>();
  x -= words.middle;
  words.tail = x.convert_to<double>();
  return words;
}

inline wide<double> wide_of(const many_digits& x) {
  const double head = x.convert_to<double>();
  return {head, many_digits(x - head).convert_to<double>()};
}

inline const many_digits& pi_in_many_digits() { return boost::math::constants::pi<many_digits>(); }

// The arithmetic–geometric mean of two numbers that are not negative (DLMF 19.8(i)).
inline many_digits mean_in_many_digits(many_digits a, many_digits b) {
  if (b == 0) return b;
  for (;;) {
    const many_digits mean = (a + b) / 2, apart = abs(a - b);
    if (!(ldexp(apart, 170) > mean)) return mean;  // the next is nearer than its square, 2^-340
    b = sqrt(many_digits(a * b));
    a = mean;
  }
}

// Half periods in a unit of the argument, stretch/2K = stretch AGM(1, kc)/π (DLMF 19.8.5).
inline many_digits half_periods_in_many_digits(const many_digits& kc, const many_digits& stretch = 1) {
  return stretch * mean_in_many_digits(1, kc) / pi_in_many_digits();
}

// The nearest whole number, whether it is even, and the rest. It wants the digits of both: the number is below 2^200.
struct counted_halves {
  double whole, parity;  // 1 for even, −1 for odd
  wide<double> rest;
};
inline counted_halves nearest_count(const many_digits& x) {
  const many_digits whole = floor(many_digits(x + 0.5)), pairs = floor(many_digits(whole / 2));
  return {whole.convert_to<double>(), 2 * pairs == whole ? 1.0 : -1.0, wide_of(x - whole)};
}

// x as whole quarter turns and a rest, |rest| ≤ π/4, for |x| < 2^62.
struct counted_quarters {
  std::int64_t quarters;
  wide<double> rest;
};
inline counted_quarters quarter_turns_off(double x) {
  const many_digits quarter = pi_in_many_digits() / 2, count = floor(many_digits(x / quarter + 0.5));
  return {count.convert_to<std::int64_t>(), wide_of(x - count * quarter)};
}

}  // namespace pendula::inline PENDULA_MACHINE
