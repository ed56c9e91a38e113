// Euler's method: Herrera et al. (2024), eq. 52.
#pragma once

#include "pendula/method/explicit_runge_kutta.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr butcher_tableau<1> euler_tableau{.name = "euler",
                                                  .order = 1,
                                                  .a = {},
                                                  .b = {{{1}}},
                                                  .source = "Euler, Institutionum calculi integralis (1768), §650"};
using euler = explicit_runge_kutta<euler_tableau>;

}  // namespace pendula::inline PENDULA_MACHINE
