// Boost's numbers of any fixed count of digits as scalars. They compute with integers: the same bits everywhere.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <unsigned decimal_digits>
using multiprecision =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<decimal_digits>, boost::multiprecision::et_off>;

template <unsigned decimal_digits>
struct elementary<multiprecision<decimal_digits>> {
  using S = multiprecision<decimal_digits>;

  static sine_cosine<S> sincos(const S& x) { return {S(sin(x)), S(cos(x))}; }
  static double rough(const S& x) { return x.template convert_to<double>(); }
  static double rough_log2(const S& x) {  // whose exponents can be beyond those of a double
    if (x == 0) return -1e6;
    int exponent = 0;
    const S part = frexp(x, &exponent);
    return pendula::rough_log2(part.template convert_to<double>()) + exponent;
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
