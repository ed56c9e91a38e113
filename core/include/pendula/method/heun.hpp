// Heun's method of order two, the explicit trapezoidal rule: Herrera et al. (2024), eq. 54 with the h it lost.
#pragma once

#include "pendula/method/explicit_runge_kutta.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr butcher_tableau<2> heun_tableau{.name = "heun",
                                                 .order = 2,
                                                 .a = {{{}, {{{1}}}}},
                                                 .b = {{{1, 2}, {1, 2}}},
                                                 .source = "Heun, Z. Math. Phys. 45 (1900) 23"};
using heun = explicit_runge_kutta<heun_tableau>;

}  // namespace pendula::inline PENDULA_MACHINE
