// The classical Runge–Kutta method of order four: Herrera et al. (2024), eq. 56.
#pragma once

#include "pendula/method/explicit_runge_kutta.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr butcher_tableau<4> rk4_tableau{.name = "rk4",
                                                .order = 4,
                                                .a = {{{}, {{{1, 2}}}, {{{}, {1, 2}}}, {{{}, {}, {1}}}}},
                                                .b = {{{1, 6}, {1, 3}, {1, 3}, {1, 6}}},
                                                .source = "Kutta, Z. Math. Phys. 46 (1901) 435"};
using rk4 = explicit_runge_kutta<rk4_tableau>;

}  // namespace pendula::inline PENDULA_MACHINE
