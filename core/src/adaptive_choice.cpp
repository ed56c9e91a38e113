// Which of the builds of the adaptive methods this processor can run.
#include "pendula/drive/adaptive_kernels.hpp"

namespace pendula_kernels {

extern const adaptive adaptive_plain;
#ifdef PENDULA_X86_KERNELS
extern const adaptive adaptive_avx2;
#endif

std::span<const adaptive* const> all_adaptive() {
#ifdef PENDULA_X86_KERNELS
  static const adaptive* const kernels[] = {&adaptive_plain, &adaptive_avx2};
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {kernels, has_avx2 ? std::size_t{2} : std::size_t{1}};
#else
  static const adaptive* const kernels[] = {&adaptive_plain};
  return kernels;
#endif
}

}  // namespace pendula_kernels
