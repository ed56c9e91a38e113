// The implicit midpoint rule, Gauss–Legendre collocation with one stage.
#pragma once

#include "pendula/method/gauss_collocation.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr collocation_table<1> midpoint_table{
    .name = "midpoint",
    .nodes = {0.5},
    .outer_weights = {},
    .below = {},
    .source = "Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), II.1.3"};
using midpoint = gauss_collocation<midpoint_table>;

}  // namespace pendula::inline PENDULA_MACHINE
