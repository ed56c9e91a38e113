// The method of Störmer and Verlet, in the version that moves the angle first: Hairer, Lubich & Wanner (2003), Acta
// Numerica 12, 399, section 1.
#pragma once

#include "pendula/method/drift_and_kick.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr composition_table<0> verlet_table{
    .name = "verlet", .order = 2, .outer = {}, .source = "Verlet, Phys. Rev. 159 (1967) 98"};
using verlet = verlet_composition<verlet_table>;

}  // namespace pendula::inline PENDULA_MACHINE
