// Seven steps of Verlet: solution A of Yoshida (1990), table 1, with the digits of Hairer, Lubich & Wanner (2006),
// V.3.11.
#pragma once

#include "pendula/method/drift_and_kick.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr composition_table<3> yoshida6_table{
    .name = "yoshida6",
    .order = 6,
    .outer = {0.78451361047755726381949763, 0.23557321335935813368479318, -1.17767998417887100694641568},
    .source = "Yoshida, Phys. Lett. A 150 (1990) 262"};
using yoshida6 = verlet_composition<yoshida6_table>;

}  // namespace pendula::inline PENDULA_MACHINE
