// How large a motion is, which errors are in parts of.
#pragma once

#include "pendula/facets.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

// The square of the amplitude of a small swing from a state (θ…, ω…), in radians.
template <Energetic Sys>
auto amplitude_squared(const Sys& system, const typename Sys::state& y) {
  const auto energy = system.kinetic_energy(y) + system.potential_energy(y);
  return rough((energy + energy) / system.energy_scale());
}

// log2 of the amplitude of a small swing, roughly; 0, one radian, of other motions and at rest. The energy of the
// smallest ones is below all numbers: 2^500 times as large they swing alike, and are still small. Below 2^-1000 what is
// made of it would not be a number.
template <Energetic Sys>
roughly<typename Sys::scalar> log2_of_amplitude(const Sys& system, const typename Sys::state& y) {
  using S = typename Sys::scalar;
  using R = roughly<S>;
  auto larger = y;
  for (S& component : larger) component = S(0x1p500) * component;
  const R of_state = amplitude_squared(system, y), of_larger = amplitude_squared(system, larger);
  const auto tiny = mask_and(less(R(0.0), of_larger), less(of_larger, R(1.0)));
  const auto small = mask_and(less(R(0.0), of_state), less(of_state, R(1.0)));
  const R amplitude = R(0.5) * choose(tiny, rough_log2(of_larger) - R(1000.0), rough_log2(of_state));
  return choose(mask_or(tiny, small), choose(less(amplitude, R(-1000.0)), R(-1000.0), amplitude), R(0.0));
}

}  // namespace pendula::inline PENDULA_MACHINE
