// Gauss–Legendre collocation of order eight: with r = √(6/5), c = 1/2 ∓ √(3/7 ± 2r/7)/2 and b = 1/4 ∓ √30/72.
#pragma once

#include "pendula/method/gauss_collocation.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr collocation_table<4> gauss8_table{
    .name = "gauss8",
    .nodes = {0.069431844202973712388, 0.33000947820757186760, 0.66999052179242813240, 0.93056815579702628761},
    .outer_weights = {0.17392742256872692869},
    .below = {{{},
               {{1.0815897500322798726}},
               {{0.96127407343211423994, 1.0855037514105193512}},
               {{1.0204404206840406424, 0.96127407343211423994, 1.0815897500322798726}}}},
    .source = "Antoñana, Makazaga & Murua, Numer. Algor. 76 (2017) 861"};
using gauss8 = gauss_collocation<gauss8_table>;

}  // namespace pendula::inline PENDULA_MACHINE
