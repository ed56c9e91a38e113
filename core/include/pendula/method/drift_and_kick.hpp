// For systems whose energy separates, H = T(p) + V(θ): motions at constant momentum and at constant angle take turns,
// each exactly, so that every composition of them is symplectic (Hairer, Lubich & Wanner 2006, II.5).
#pragma once

#include "pendula/method/parts_of_step.hpp"
#include "pendula/scalar/compensated.hpp"

namespace pendula {

// Angle and velocity, with what rounding takes from the sums.
template <class S>
struct drifting {
  compensated_point<vec<S, 1>> theta, omega;

  PENDULA_INLINE void drift(S h) { theta = theta.moved_by({h * omega.head[0]}); }
  template <class Sys>
  PENDULA_INLINE void kick(const Sys& system, S h) {
    omega = omega.moved_by({h * system.acceleration(theta.head[0])});
  }

  PENDULA_INLINE friend vec<S, 2> head_of(const drifting& at) { return {at.theta.head[0], at.omega.head[0]}; }
  friend void lay_to_rest(drifting& at, int i) {
    for (auto* each : {&at.theta, &at.omega}) {
      set_lane(each->head[0], i, 0.0);
      set_lane(each->tail[0], i, 0.0);
    }
  }
};

// What all methods made of them have in common.
struct of_drifts_and_kicks {
  static constexpr bool adaptive = false, symplectic = true;
  template <SystemOver Sys>
  static constexpr bool takes = Sys::separable;

  template <SystemOver Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static drifting<S> begin(const Sys& system, const typename Sys::state& y) {
    const auto [theta, omega] = system.canonical(y);
    return {{{theta}, {S(0.0)}}, {{omega}, {S(0.0)}}};
  }
  template <SystemOver Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static typename Sys::state state_of(const Sys& system, const drifting<S>& at) {
    return system.from_canonical(head_of(at));
  }
};

// Störmer–Verlet steps of several lengths, the same from both ends: `outer` names them in parts of the whole, from the
// ends inward, without the one in the middle.
template <std::size_t outer_steps>
struct composition_table {
  std::string_view name;
  int order;
  std::array<double, outer_steps> outer;
  std::string_view source;
};

template <const auto& tableau>
struct verlet_composition : of_drifts_and_kicks {
  static constexpr std::string_view name = tableau.name;
  static constexpr int order = tableau.order;
  static constexpr std::size_t steps = 2 * tableau.outer.size() + 1;
  static constexpr int evaluations_per_step = static_cast<int>(steps);
  static constexpr std::string_view source = tableau.source;

  // Half drifts of neighbours are one.
  template <SystemOver Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static drifting<S> step(const Sys& system, drifting<S> at, S h) {
    const std::array<S, steps> part = parts_of_step<steps>(h, tableau.outer);
    at.drift(S(0.5) * part[0]);
    for (std::size_t i = 0; i + 1 < steps; ++i) {
      at.kick(system, part[i]);
      at.drift(S(0.5) * (part[i] + part[i + 1]));
    }
    at.kick(system, part[steps - 1]);
    at.drift(S(0.5) * part[steps - 1]);
    return at;
  }
};

}  // namespace pendula
