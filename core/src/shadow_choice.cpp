// Which of the builds of the shadow this processor can run.
#include "pendula/drive/shadow_kernels.hpp"

namespace pendula_kernels {

extern const shadow_maker shadow_plain;
#ifdef PENDULA_X86_KERNELS
extern const shadow_maker shadow_avx2;
#endif

const shadow_maker& best_shadow_maker() {
#ifdef PENDULA_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return shadow_avx2;
#endif
  return shadow_plain;
}

}  // namespace pendula_kernels
