// Angles without their whole turns.
#pragma once

#include <cmath>

#include "pendula/scalar/sincos.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr double largest_turned_angle = 0x1p52;

// The same direction within half a turn, for angles that the sine has no digits for; up to there, the angle itself.
inline double within_range_of_sine(double x) {
  if (!(std::fabs(x) >= largest_angle && std::fabs(x) < largest_turned_angle)) return x;
  const double n = nearest_whole(x * 0x1.45f306dc9c883p-3);  // 1/2π; then 2π in three parts
  const wide<double> first(two_product(n, 0x1.921fb54442d18p+2)), second(two_product(n, 0x1.1a62633145c07p-52));
  return rounded(((wide<double>(x) - first) - second) - wide<double>(n * -0x1.f1976b7ed8fbcp-108));
}

}  // namespace pendula::inline PENDULA_MACHINE
