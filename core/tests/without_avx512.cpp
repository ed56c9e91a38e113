// In place of the kernels built for AVX-512, which take long to compile with the sanitizers: those for AVX2 are of the
// same sources. Tests under the sanitizers choose a lesser machine, so that nobody calls these.
#include "pendula/kernels/exact_kernels.hpp"
#include "pendula/kernels/variations.hpp"

namespace pendula::avx512 {

extern const exact_kernel exact_loops{};
extern const lanes_kernel adaptive_lanes{}, fixed_lanes{};
extern const variation_kernel variation_lanes{};

}  // namespace pendula::avx512
