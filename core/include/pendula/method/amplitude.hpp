// How large a motion is, which errors are in parts of.
#pragma once

#include "pendula/facets.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

// The square of the amplitude of a small swing from a state (θ…, ω…), in radians, and of what a drive adds to it.
template <Energetic Sys>
auto amplitude_squared(const Sys& system, const typename Sys::state& y) {
  const auto energy = system.kinetic_energy(y) + system.potential_energy(y);
  const auto of_energy = rough((energy + energy) / system.energy_scale());
  if constexpr (requires { system.forced_amplitude_squared(); }) {
    return of_energy + system.forced_amplitude_squared();
  } else {
    return of_energy;
  }
}

// log2 of the amplitude of a small swing, roughly; 0, one radian, of other motions and at rest. The energy of the
// smallest ones is below all numbers: of those, a swing of some 2^-10 rad is looked at that is alike but for its size.
template <Energetic Sys>
roughly<typename Sys::scalar> log2_of_amplitude(const Sys& system, const typename Sys::state& y) {
  using S = typename Sys::scalar;
  using R = roughly<S>;
  auto alike = y;
  R largest(0.0);
  for (S& component : alike) {
    component = S(0x1p500) * component;
    const R size = magnitude(rough(component));
    largest = choose(less(largest, size), size, largest);
  }
  const R log2_of_largest = rough_log2(largest);
  for (S& component : alike) component = S(rough_exp2(R(-10.0) - log2_of_largest)) * component;
  const R of_state = amplitude_squared(system, y), of_alike = amplitude_squared(system, alike);
  const auto tiny = mask_and(less(R(0.0), largest), less(largest, R(0x1p100)));
  const auto small = mask_and(less(R(0.0), of_state), less(of_state, R(1.0)));
  const R of_tiny = R(0.5) * rough_log2(of_alike) + (log2_of_largest - R(490.0));
  return choose(tiny, of_tiny, choose(small, R(0.5) * rough_log2(of_state), R(0.0)));
}

}  // namespace pendula::inline PENDULA_MACHINE
