// The counts of words that runs are made with: their arithmetic stands in long_arithmetic.cpp.
#pragma once

#include "pendula/scalar/long_number.hpp"

namespace pendula::inline PENDULA_MACHINE {

extern template struct long_number<3>;
extern template struct long_number<4>;
extern template struct long_number<6>;
extern template struct long_number<8>;
extern template struct long_number<11>;
extern template struct long_number<16>;

}  // namespace pendula::inline PENDULA_MACHINE
