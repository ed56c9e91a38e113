// Gauss–Legendre collocation of order six: c = 1/2, 1/2 ∓ √15/10, and b_1 = 5/18.
#pragma once

#include "pendula/method/gauss_collocation.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr collocation_table<3> gauss6_table{
    .name = "gauss6",
    .nodes = {0.11270166537925831148, 0.5, 0.88729833462074168852},
    .outer_weights = {5.0 / 18.0},
    .below = {{{}, {{1.0809475019311125328}}, {{0.96475800154489002622, 1.0809475019311125328}}}},
    .source = "Antoñana, Makazaga & Murua, Numer. Algor. 76 (2017) 861"};
using gauss6 = gauss_collocation<gauss6_table>;

}  // namespace pendula::inline PENDULA_MACHINE
