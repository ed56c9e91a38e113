// In place of the kernels built for other machines than AVX2, which take long to compile with the sanitizers and are of
// the same sources. Tests under the sanitizers choose that machine, so that nobody calls these.
#include "pendula/kernels/derivatives.hpp"
#include "pendula/kernels/exact_kernels.hpp"
#include "pendula/kernels/run_kernels.hpp"
#include "pendula/kernels/shadow_kernels.hpp"
#include "pendula/kernels/variations.hpp"

namespace pendula::plain {

extern const run_kernel adaptive_runs{};
extern const derivative_kernel derivative_runs{};
extern const shadow_maker shadows{};
extern const variation_kernel variation_lanes{};

}  // namespace pendula::plain

namespace pendula::avx512 {

extern const exact_kernel exact_loops{};
extern const lanes_kernel adaptive_lanes{}, fixed_lanes{};
extern const variation_kernel variation_lanes{};

}  // namespace pendula::avx512
