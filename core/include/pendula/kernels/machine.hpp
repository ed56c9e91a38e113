// The machines that loops are built for, into one program that takes the best that its processor is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <string_view>

namespace pendula {

enum class machine { plain, avx2, avx512 };
inline constexpr std::string_view machine_names[] = {"plain", "avx2", "avx512"};

// The least machine that this program serves, and the best that it makes use of: kernels for lesser or better ones
// alone are not in it (core/src/CMakeLists.txt).
#ifdef PENDULA_LEAST_MACHINE
inline constexpr machine least_machine = machine::PENDULA_LEAST_MACHINE, most_machine = machine::PENDULA_MOST_MACHINE;
#else
inline constexpr machine least_machine = machine::plain, most_machine = machine::avx512;
#endif

// The best that this processor is and this program makes use of, or the lesser one that the environment variable
// PENDULA_MACHINE names. Throws std::invalid_argument where that names none, or one that this program does not serve.
machine machine_here();

// A kernel that is of use up to the machine `last`; null where it is not in this program.
template <class Kernel>
constexpr const Kernel* until(machine last, const Kernel& kernel) {
  return last < least_machine ? nullptr : &kernel;
}
// The same of one that is of use from the machine `first` on.
template <class Kernel>
constexpr const Kernel* from(machine first, const Kernel& kernel) {
  return most_machine < first ? nullptr : &kernel;
}

// Of builds for one machine after another, those that run here, the best one last; perhaps none. Those that are not in
// this program are left out.
template <class Kernel, std::size_t n>
std::span<const Kernel* const> built_for_here(const Kernel* const (&all)[n], machine first = machine::plain) {
  const int count = static_cast<int>(machine_here()) - static_cast<int>(first) + 1;
  const std::span<const Kernel* const> here(all, static_cast<std::size_t>(std::clamp(count, 0, static_cast<int>(n))));
  return here.subspan(static_cast<std::size_t>(std::ranges::count(here, nullptr)));  // of lesser machines
}

}  // namespace pendula
