// Which of the builds of lanes this processor runs.
#include <algorithm>

#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/lanes_kernels.hpp"
#include "pendula/kernels/machine.hpp"
#include "pendula/kernels/variations.hpp"

namespace pendula {

namespace plain {
extern const variation_kernel variation_lanes;
}  // namespace plain

#ifdef PENDULA_X86_KERNELS
namespace avx2 {
extern const lanes_kernel adaptive_lanes, fixed_lanes;
extern const variation_kernel variation_lanes;
}  // namespace avx2
namespace avx512 {
extern const lanes_kernel adaptive_lanes, fixed_lanes;
extern const variation_kernel variation_lanes;
}  // namespace avx512
static constexpr const variation_kernel* variation_kernels[] = {until(machine::plain, plain::variation_lanes),
                                                                &avx2::variation_lanes,
                                                                from(machine::avx512, avx512::variation_lanes)};
static constexpr const lanes_kernel* adaptive_kernels[] = {&avx2::adaptive_lanes,
                                                           from(machine::avx512, avx512::adaptive_lanes)};
static constexpr const lanes_kernel* fixed_kernels[] = {until(machine::avx2, avx2::fixed_lanes),
                                                        from(machine::avx512, avx512::fixed_lanes)};
static constexpr machine first = machine::avx2;
#else
namespace plain {
extern const lanes_kernel adaptive_lanes, fixed_lanes;
}  // namespace plain
static constexpr const variation_kernel* variation_kernels[] = {&plain::variation_lanes};
static constexpr const lanes_kernel* adaptive_kernels[] = {&plain::adaptive_lanes};
static constexpr const lanes_kernel* fixed_kernels[] = {&plain::fixed_lanes};
static constexpr machine first = machine::plain;
#endif

std::span<const lanes_kernel* const> lanes_kernels_for(const request& asked) {
  return built_for_here(method_named(asked.method)->adaptive ? adaptive_kernels : fixed_kernels, first);
}

const variation_kernel& variation_kernel_for(std::size_t rows) {
  const auto all = built_for_here(variation_kernels);
  return *all[rows <= 4 ? std::min<std::size_t>(1, all.size() - 1) : all.size() - 1];
}

}  // namespace pendula
