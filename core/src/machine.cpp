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

std::string name_of(machine m) { return std::string(machine_names[static_cast<std::size_t>(m)]); }

machine chosen_machine() {
  if (best_machine() < least_machine)
    throw std::invalid_argument("this build of pendula is for processors with " + name_of(least_machine) +
                                ", which this one lacks; build it here, or with PENDULA_LEAST_MACHINE=plain");
  const char* const asked = std::getenv("PENDULA_MACHINE");
  if (asked == nullptr || *asked == 0) return std::min(best_machine(), most_machine);
  const auto found = std::find(std::begin(machine_names), std::end(machine_names), asked);
  if (found == std::end(machine_names))
    throw std::invalid_argument("PENDULA_MACHINE must be one of plain, avx2, avx512; got '" + std::string(asked) +
                                "'; unset it for the best that this processor is");
  const auto chosen = std::min({best_machine(), most_machine, static_cast<machine>(found - std::begin(machine_names))});
  if (chosen < least_machine)
    throw std::invalid_argument("PENDULA_MACHINE must be " + name_of(least_machine) +
                                " or better in this build; got '" + std::string(asked) +
                                "'; unset it, or build with PENDULA_LEAST_MACHINE=plain");
  return chosen;
}

}  // namespace

machine machine_here() {
  static const machine here = chosen_machine();
  return here;
}

}  // namespace pendula
