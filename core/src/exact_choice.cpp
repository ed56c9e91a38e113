// Which of the builds of the closed form this processor can run.
#include "pendula/drive/exact_kernels.hpp"
#include "pendula/drive/machine.hpp"

namespace pendula_kernels {

#ifdef PENDULA_X86_KERNELS
extern const exact exact_plain, exact_avx2, exact_avx512;
static const exact* const kernels[] = {&exact_plain, &exact_avx2, &exact_avx512};
#else
extern const exact exact_plain;
static const exact* const kernels[] = {&exact_plain};
#endif

std::span<const exact* const> all_exact() { return built_for_here(kernels); }

}  // namespace pendula_kernels
