// Which of the builds of one trajectory's runs, and of the shadow beside them, this processor runs.
#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/derivatives.hpp"
#include "pendula/kernels/machine.hpp"
#include "pendula/kernels/run_kernels.hpp"
#include "pendula/kernels/shadow_kernels.hpp"

namespace pendula {

namespace plain {
extern const run_kernel fixed_runs, adaptive_runs;
extern const derivative_kernel derivative_runs;
extern const shadow_maker shadows;
}  // namespace plain

#ifdef PENDULA_X86_KERNELS
namespace avx2 {
extern const run_kernel adaptive_runs;
extern const derivative_kernel derivative_runs;
extern const shadow_maker shadows;
}  // namespace avx2
static constexpr const run_kernel* adaptive_kernels[] = {until(machine::plain, plain::adaptive_runs),
                                                         &avx2::adaptive_runs};
static constexpr const derivative_kernel* derivative_kernels[] = {until(machine::plain, plain::derivative_runs),
                                                                  &avx2::derivative_runs};
static constexpr const shadow_maker* shadow_makers[] = {until(machine::plain, plain::shadows), &avx2::shadows};
#else
static constexpr const run_kernel* adaptive_kernels[] = {&plain::adaptive_runs};
static constexpr const derivative_kernel* derivative_kernels[] = {&plain::derivative_runs};
static constexpr const shadow_maker* shadow_makers[] = {&plain::shadows};
#endif

const run_kernel& kernel_for(const request& asked) {
  const bool adaptive = method_named(asked.method)->adaptive;
  return adaptive ? *built_for_here(adaptive_kernels).back() : plain::fixed_runs;  // those are as fast everywhere
}

const derivative_kernel& best_derivative_kernel() { return *built_for_here(derivative_kernels).back(); }

const shadow_maker& best_shadow_maker() { return *built_for_here(shadow_makers).back(); }

}  // namespace pendula
