// Three steps of Verlet, the outer ones 1/(2 − 2^{1/3}) long: Forest & Ruth (1990), Physica D 43, 105; Yoshida
// (1990), Phys. Lett. A 150, 262; Hairer, Lubich & Wanner (2006), II.4.4.
#pragma once

#include "pendula/method/drift_and_kick.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr composition_table<1> yoshida4_table{.name = "yoshida4",
                                                     .order = 4,
                                                     .outer = {1.3512071919596576340},
                                                     .source = "Yoshida, Phys. Lett. A 150 (1990) 262"};
using yoshida4 = verlet_composition<yoshida4_table>;

}  // namespace pendula::inline PENDULA_MACHINE
