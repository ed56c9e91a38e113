// Fifteen steps of Verlet in the manner of Yoshida (1990), of the lengths that Suzuki & Umeno (1993) found: the longest
// is 0.8 of the whole where Yoshida's are 1.9. Digits of Hairer, Lubich & Wanner (2006), V.3.12.
#pragma once

#include "pendula/method/drift_and_kick.hpp"

namespace pendula::inline PENDULA_MACHINE {

inline constexpr composition_table<7> yoshida8_table{
    .name = "yoshida8",
    .order = 8,
    .outer = {0.74167036435061295344822780, -0.40910082580003159399730010, 0.19075471029623837995387626,
              -0.57386247111608226665638773, 0.29906418130365592384446354, 0.33462491824529818378495798,
              0.31529309239676659663205666},
    .source = "Suzuki & Umeno, Springer Proc. Phys. 76 (1993) 74"};
using yoshida8 = verlet_composition<yoshida8_table>;

}  // namespace pendula::inline PENDULA_MACHINE
