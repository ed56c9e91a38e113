// The arithmetic of many words, compiled apart: runs spend their time in it, and what calls it needs less care.
#include "pendula/kernels/long_arithmetic.hpp"

namespace pendula::inline PENDULA_MACHINE {

template struct long_number<3>;
template struct long_number<4>;
template struct long_number<6>;
template struct long_number<8>;
template struct long_number<11>;
template struct long_number<16>;

}  // namespace pendula::inline PENDULA_MACHINE
