// The symplectic Euler method, kick and drift: Hairer, Lubich & Wanner (2006), I.1.9.
#pragma once

#include "pendula/method/drift_and_kick.hpp"

namespace pendula::inline PENDULA_MACHINE {

struct symplectic_euler : splitting_method {
  static constexpr std::string_view name = "symplectic-euler";
  static constexpr int order = 1, evaluations_per_step = 1;
  static constexpr std::string_view source = "Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), I.1.2";

  template <Separable Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static drift_kick_state<Sys> step(const Sys& system, S t, drift_kick_state<Sys> at, S h) {
    at.kick(system, t, h);
    at.drift(h);
    return at;
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
