// The symplectic Euler method, kick and drift: Hairer, Lubich & Wanner (2006), I.1.9.
#pragma once

#include "pendula/method/drift_and_kick.hpp"

namespace pendula {

struct symplectic_euler : of_drifts_and_kicks {
  static constexpr std::string_view name = "symplectic-euler";
  static constexpr int order = 1, evaluations_per_step = 1;
  static constexpr std::string_view source = "Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), I.1.2";

  template <SystemOver Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static drifting<S> step(const Sys& system, drifting<S> at, S h) {
    at.kick(system, h);
    at.drift(h);
    return at;
  }
};

}  // namespace pendula
