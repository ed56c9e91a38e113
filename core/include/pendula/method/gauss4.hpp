// Gauss–Legendre collocation of order four: c = 1/2 ∓ √3/6, μ_21 = 1/2 + √3/3.
#pragma once

#include "pendula/method/gauss_collocation.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr collocation_table<2> gauss4_table{.name = "gauss4",
                                                   .nodes = {0.21132486540518711775, 0.78867513459481288225},
                                                   .outer_weights = {},
                                                   .below = {{{}, {{1.0773502691896257645}}}},
                                                   .source = "Antoñana, Makazaga & Murua, Numer. Algor. 76 (2017) 861"};
using gauss4 = gauss_collocation<gauss4_table>;

}  // namespace pendula::inline PENDULA_MACHINE
