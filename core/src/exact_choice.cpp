// Which of the builds of the closed form this processor runs.
#include "pendula/kernels/exact_kernels.hpp"
#include "pendula/kernels/machine.hpp"

namespace pendula {

namespace plain {
extern const exact_kernel exact_loops;
}  // namespace plain

#ifdef PENDULA_X86_KERNELS
namespace avx2 {
extern const exact_kernel exact_loops;
}  // namespace avx2
namespace avx512 {
extern const exact_kernel exact_loops;
}  // namespace avx512
static constexpr const exact_kernel* kernels[] = {until(machine::plain, plain::exact_loops),
                                                  until(machine::avx2, avx2::exact_loops),
                                                  from(machine::avx512, avx512::exact_loops)};
#else
static constexpr const exact_kernel* kernels[] = {&plain::exact_loops};
#endif

std::span<const exact_kernel* const> all_exact() { return built_for_here(kernels); }

}  // namespace pendula
