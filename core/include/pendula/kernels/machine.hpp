// The machines that loops are built for, into one program that takes the best that its processor is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

namespace pendula {

enum class machine { plain, avx2, avx512 };
inline constexpr std::string_view machine_names[] = {"plain", "avx2", "avx512"};

// The best that this processor is, or the lesser one that the environment variable PENDULA_MACHINE names.
// Throws std::invalid_argument where that names none.
machine machine_here();

// Of builds for one machine after another, those that run here, the best one last; perhaps none.
template <class Kernels, std::size_t n>
std::span<const Kernels* const> built_for_here(const Kernels* const (&all)[n], machine first = machine::plain) {
  const int count = static_cast<int>(machine_here()) - static_cast<int>(first) + 1;
  return {all, static_cast<std::size_t>(std::clamp(count, 0, static_cast<int>(n)))};
}

}  // namespace pendula
