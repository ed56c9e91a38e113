// What the tests take for the truth: Boost.Multiprecision with 60 digits, and distances in units in the last place.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

namespace truth {

using number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

// |got − want| in units of the last place of the double nearest to want.
inline double ulps(double got, const number& want) {
  const double nearest = std::fabs(want.convert_to<double>());
  const double unit = nearest == 0.0 ? std::numeric_limits<double>::denorm_min()
                                     : std::ldexp(1.0, std::ilogb(nearest) - 52);
  return abs((number(got) - want) / unit).convert_to<double>();
}

}  // namespace truth
