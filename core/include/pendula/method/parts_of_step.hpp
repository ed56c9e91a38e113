// Parts of a step that are the same from both ends and sum to the step, exactly or, where the middle one is longer than
// the step, to its rounding: were the sum off, the motion would be late by as much at every step.
#pragma once

#include "pendula/concepts.hpp"

namespace pendula::inline PENDULA_MACHINE {

// The parts are `outer` times the step from both ends inward, and the middle one, or the middle two, what is left.
template <std::size_t parts, class S>
PENDULA_INLINE std::array<S, parts> parts_of_step(S h, const std::array<double, (parts - 1) / 2>& outer) {
  std::array<S, parts> part;
  S rest = h;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const S magic = S(6.0) * h;  // rounds parts of less than 2 h to a grid of which their sums are multiples, too
    part[i] = part[parts - 1 - i] = (S(outer[i]) * h + magic) - magic;
    rest = rest - (part[i] + part[i]);
  }
  part[outer.size()] = part[parts - 1 - outer.size()] = parts % 2 == 1 ? rest : S(0.5) * rest;
  return part;
}

}  // namespace pendula::inline PENDULA_MACHINE
