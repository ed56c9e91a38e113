#include "pendula/kernels/machine.hpp"

#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string>

namespace pendula {

namespace {

machine best_machine() {
#ifdef PENDULA_X86_KERNELS
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return machine::plain;
  const bool wider =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return wider ? machine::avx512 : machine::avx2;
#else
  return machine::plain;
#endif
}

machine chosen_machine() {
  const char* const asked = std::getenv("PENDULA_MACHINE");
  if (asked == nullptr || *asked == 0) return best_machine();
  const auto found = std::find(std::begin(machine_names), std::end(machine_names), asked);
  if (found == std::end(machine_names))
    throw std::invalid_argument("PENDULA_MACHINE must be one of plain, avx2, avx512; got '" + std::string(asked) +
                                "'; unset it for the best that this processor is");
  return std::min(best_machine(), static_cast<machine>(found - std::begin(machine_names)));
}

}  // namespace

machine machine_here() {
  static const machine here = chosen_machine();
  return here;
}

}  // namespace pendula
