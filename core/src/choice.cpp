// Which of the builds of each kernel this processor runs.
#include "pendula/kernels/catalogue.hpp"
#include "pendula/kernels/exact_kernels.hpp"
#include "pendula/kernels/lanes_kernels.hpp"
#include "pendula/kernels/machine.hpp"
#include "pendula/kernels/run_kernels.hpp"
#include "pendula/kernels/shadow_kernels.hpp"

namespace pendula {

namespace plain {
extern const run_kernel fixed_runs, adaptive_runs;
extern const shadow_maker shadows;
}  // namespace plain

#ifdef PENDULA_X86_KERNELS
namespace avx2 {
extern const run_kernel adaptive_runs;
extern const shadow_maker shadows;
extern const lanes_kernel adaptive_lanes, fixed_lanes;
}  // namespace avx2
namespace avx512 {
extern const lanes_kernel adaptive_lanes, fixed_lanes;
}  // namespace avx512
static const run_kernel* const adaptive_kernels[] = {&plain::adaptive_runs, &avx2::adaptive_runs};
static const shadow_maker* const shadow_makers[] = {&plain::shadows, &avx2::shadows};
static const lanes_kernel* const adaptive_lanes_kernels[] = {&avx2::adaptive_lanes, &avx512::adaptive_lanes};
static const lanes_kernel* const fixed_lanes_kernels[] = {&avx2::fixed_lanes, &avx512::fixed_lanes};
static constexpr machine first_with_lanes = machine::avx2;
#else
namespace plain {
extern const lanes_kernel adaptive_lanes, fixed_lanes;
}  // namespace plain
static const run_kernel* const adaptive_kernels[] = {&plain::adaptive_runs};
static const shadow_maker* const shadow_makers[] = {&plain::shadows};
static const lanes_kernel* const adaptive_lanes_kernels[] = {&plain::adaptive_lanes};
static const lanes_kernel* const fixed_lanes_kernels[] = {&plain::fixed_lanes};
static constexpr machine first_with_lanes = machine::plain;
#endif

const run_kernel& kernel_for(const request& asked) {
  const bool adaptive = method_named(asked.method)->adaptive;
  return adaptive ? *built_for_here(adaptive_kernels).back() : plain::fixed_runs;  // those are as fast everywhere
}

const shadow_maker& best_shadow_maker() { return *built_for_here(shadow_makers).back(); }

std::span<const lanes_kernel* const> lanes_kernels_for(const request& asked) {
  const bool adaptive = method_named(asked.method)->adaptive;
  return built_for_here(adaptive ? adaptive_lanes_kernels : fixed_lanes_kernels, first_with_lanes);
}

}  // namespace pendula
