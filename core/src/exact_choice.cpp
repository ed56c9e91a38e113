#include <array>

#include "pendula/drive/exact_kernels.hpp"

namespace pendula_kernels {

extern const exact exact_plain;
#ifdef PENDULA_X86_KERNELS
extern const exact exact_avx2, exact_avx512;
#endif

std::span<const exact* const> all_exact() {
  static const auto found = [] {
    struct {
      std::array<const exact*, 3> kernels{&exact_plain};
      std::size_t count = 1;
    } some;
#ifdef PENDULA_X86_KERNELS
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) some.kernels[some.count++] = &exact_avx2;
    if (some.count == 2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
      some.kernels[some.count++] = &exact_avx512;
#endif
    return some;
  }();
  return {found.kernels.data(), found.count};
}

}  // namespace pendula_kernels
