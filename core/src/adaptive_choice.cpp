// Which of the builds of the adaptive methods, and of the shadow beside them, this processor can run.
#include "pendula/drive/adaptive_kernels.hpp"
#include "pendula/drive/machine.hpp"
#include "pendula/drive/shadow_kernels.hpp"

namespace pendula_kernels {

#ifdef PENDULA_X86_KERNELS
extern const adaptive adaptive_plain, adaptive_avx2;
extern const shadow_maker shadow_plain, shadow_avx2;
static const adaptive* const kernels[] = {&adaptive_plain, &adaptive_avx2};
static const shadow_maker* const makers[] = {&shadow_plain, &shadow_avx2};
#else
extern const adaptive adaptive_plain;
extern const shadow_maker shadow_plain;
static const adaptive* const kernels[] = {&adaptive_plain};
static const shadow_maker* const makers[] = {&shadow_plain};
#endif

std::span<const adaptive* const> all_adaptive() { return built_for_here(kernels); }
const shadow_maker& best_shadow_maker() { return *built_for_here(makers).back(); }

}  // namespace pendula_kernels
