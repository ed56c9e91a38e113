// What the tests take for the truth: Boost.Multiprecision with 60 digits, and distances in units in the last place.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

namespace truth {

using number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<60>, boost::multiprecision::et_off>;

// The distance between doubles next to a number.
inline double unit_in_last_place(const number& x) {
  const double nearest = std::fabs(x.convert_to<double>());
  return nearest == 0.0 ? std::numeric_limits<double>::denorm_min() : std::ldexp(1.0, std::ilogb(nearest) - 52);
}

// |got − want| in those units.
inline double ulps(double got, const number& want) {
  return abs((number(got) - want) / unit_in_last_place(want)).convert_to<double>();
}

}  // namespace truth
