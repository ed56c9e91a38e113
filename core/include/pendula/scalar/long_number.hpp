// A number of so many 64-bit words, for runs that need more digits than a wide number has: sign, whole words and a
// power of 2^64. Nothing is ever shifted by bits, which costs up to 63 of the first word's and makes it some times as
// fast as Boost's numbers; all of it is done with integers: the same bits everywhere. Results are cut off, not rounded:
// errors are a few units in the last word, and `scalar/long_sincos.hpp` has the sine.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <int words>
struct long_number {
  static_assert(words >= 3, "a double, or the product of two, has to fit");
  using word = std::uint64_t;
  __extension__ using two_words = unsigned __int128;

  // ± Σ word[i] 2^(64 (exponent − 1 − i)), word[0] ≠ 0; zero has sign 0.
  int sign;
  std::int64_t exponent;
  word digit[words];

  long_number() = default;
  long_number(double x);

  // What is left in any case, as word[0] may be as small as 1.
  static constexpr int bits = 64 * (words - 1);
  static constexpr int decimal_digits = static_cast<int>(bits * 0.30103);

  friend long_number operator-(long_number a) {
    a.sign = -a.sign;
    return a;
  }
  friend long_number operator+(const long_number& a, const long_number& b) {
    if (a.sign == 0) return b;
    if (b.sign == 0) return a;
    const bool first = a.exponent > b.exponent || (a.exponent == b.exponent && a.digit[0] >= b.digit[0]);
    const long_number &larger = first ? a : b, &smaller = first ? b : a;
    return a.sign == b.sign ? sum(larger, smaller) : difference(larger, smaller);
  }
  friend long_number operator-(const long_number& a, const long_number& b) { return a + -b; }
  friend long_number operator*(const long_number& a, const long_number& b) { return product(a, b); }
  friend long_number operator/(const long_number& a, const long_number& b) { return a * b.inverse(); }

  double rounded() const;  // to a double: infinite or zero beyond its range
  double rough_log2() const;

 private:
  // |larger| + |smaller|, where the second is shorter by some words.
  [[gnu::noinline]] static long_number sum(const long_number& larger, const long_number& smaller);
  // |larger| − |smaller|, of which the first can be a little smaller in the end.
  [[gnu::noinline]] static long_number difference(const long_number& larger, const long_number& smaller);
  [[gnu::noinline]] static long_number product(const long_number& a, const long_number& b);
  long_number inverse() const;

  // A word of the product: adds the products of that column to the sum, and takes its last word off.
  template <int place>
  PENDULA_INLINE static word column(const long_number& a, const long_number& b, two_words& sum) {
    word beyond = 0;  // the words of the sum
#pragma GCC unroll 64
    for (int i = place < words ? 0 : place - words + 1; i <= place && i < words; ++i) {
      const two_words here = static_cast<two_words>(a.digit[i]) * b.digit[place - i];
      sum += here;
      beyond += sum < here;
    }
    const word last = static_cast<word>(sum);
    sum = (sum >> 64) | (static_cast<two_words>(beyond) << 64);
    return last;
  }

  // Takes zeros off the front.
  void settle() {
    int zeros = 0;
    while (zeros < words && digit[zeros] == 0) ++zeros;
    if (zeros == 0) return;
    if (zeros == words) {
      *this = long_number(0.0);
      return;
    }
    for (int i = 0; i < words; ++i) digit[i] = i + zeros < words ? digit[i + zeros] : 0;
    exponent -= zeros;
  }
  // Words of `smaller` that are left when it is written under `larger`.
  static int overlap(const long_number& larger, const long_number& smaller) {
    const std::int64_t apart = larger.exponent - smaller.exponent;
    return apart < words ? words - static_cast<int>(apart) : 0;
  }
};

template <int words>
long_number<words>::long_number(double x) : sign((x > 0.0) - (x < 0.0)), exponent(0), digit{} {
  if (sign == 0) return;
  int power = 0;
  const double part = std::frexp(std::fabs(x), &power);  // 53 bits, over two words at most
  exponent = (power + 63) >> 6;
  const two_words whole = static_cast<two_words>(std::ldexp(part, 53)) << (75 + power - 64 * exponent);
  digit[0] = static_cast<word>(whole >> 64);
  digit[1] = static_cast<word>(whole);
}

template <int words>
double long_number<words>::rounded() const {
  if (sign == 0) return 0.0;
  const word low = 0x7ff;  // what a double has no room for
  const double first = static_cast<double>(digit[0] & ~low);
  const double second = static_cast<double>(digit[0] & low) + static_cast<double>(digit[1]) * 0x1p-64;
  const int power = static_cast<int>(std::clamp<std::int64_t>(exponent, -100, 100)) * 64 - 64;
  return sign * std::ldexp(first + second, power);
}

template <int words>
double long_number<words>::rough_log2() const {
  if (sign == 0) return -1e6;
  const double first_two = static_cast<double>(digit[0]) + static_cast<double>(digit[1]) * 0x1p-64;
  return pendula::rough_log2(first_two) + 64.0 * static_cast<double>(exponent - 1);
}

template <int words>
long_number<words> long_number<words>::sum(const long_number& larger, const long_number& smaller) {
  long_number result = larger;
  const int overlapping = overlap(larger, smaller);
  word carry = 0;
  int to = words - 1;
  for (int from = overlapping - 1; from >= 0; --from, --to) {
    const two_words here = static_cast<two_words>(larger.digit[to]) + smaller.digit[from] + carry;
    result.digit[to] = static_cast<word>(here);
    carry = static_cast<word>(here >> 64);
  }
  for (; carry != 0 && to >= 0; --to) carry = ++result.digit[to] == 0;
  if (carry == 0) return result;
  for (int i = words - 1; i > 0; --i) result.digit[i] = result.digit[i - 1];
  result.digit[0] = 1;
  ++result.exponent;
  return result;
}

template <int words>
long_number<words> long_number<words>::difference(const long_number& larger, const long_number& smaller) {
  long_number result = larger;
  const int overlapping = overlap(larger, smaller);
  word borrow = 0;
  int to = words - 1;
  for (int from = overlapping - 1; from >= 0; --from, --to) {
    const two_words here = static_cast<two_words>(larger.digit[to]) - smaller.digit[from] - borrow;
    result.digit[to] = static_cast<word>(here);
    borrow = static_cast<word>(here >> 64) & 1;
  }
  for (; borrow != 0 && to >= 0; --to) borrow = result.digit[to]-- == 0;
  if (borrow != 0) {  // the other one was larger: its words, from the last on
    result.sign = -result.sign;
    bool zeros = true;
    for (int i = words - 1; i >= 0; --i) {
      result.digit[i] = zeros ? -result.digit[i] : ~result.digit[i];
      zeros = zeros && result.digit[i] == 0;
    }
  }
  if (result.digit[0] == 0) result.settle();
  return result;
}

// Of the words beyond the last only those are worked out that the last one needs, should the first be zero.
template <int words>
long_number<words> long_number<words>::product(const long_number& a, const long_number& b) {
  long_number result;
  result.sign = a.sign * b.sign;
  if (result.sign == 0) return long_number(0.0);
  word digit[words + 2];
  two_words sum = 0;
  [&]<int... places>(std::integer_sequence<int, places...>) {
    ((digit[words + 1 - places] = column<words - places>(a, b, sum)), ...);
  }(std::make_integer_sequence<int, words + 1>{});
  digit[0] = static_cast<word>(sum);
  const int zeros = digit[0] == 0;
  result.exponent = a.exponent + b.exponent - zeros;
  for (int i = 0; i < words; ++i) result.digit[i] = digit[i + zeros];
  return result;
}

// Newton's iteration: each step doubles the digits that are right.
template <int words>
long_number<words> long_number<words>::inverse() const {
  long_number scaled = *this;
  scaled.exponent = 0;
  long_number result(1.0 / scaled.rounded());
  const long_number one(1.0);
  for (int right = 50; right < 64 * words; right *= 2) result = result + result * (one - scaled * result);
  result.exponent -= exponent;
  return result;
}

}  // namespace pendula::inline PENDULA_MACHINE
