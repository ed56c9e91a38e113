// For systems whose energy separates, H = T(p) + V(t, θ): motions at constant momentum and at constant angle take
// turns, each exactly, so that every composition of them is symplectic (Hairer, Lubich & Wanner 2006, II.5).
#pragma once

#include "pendula/description.hpp"
#include "pendula/method/parts_of_step.hpp"
#include "pendula/scalar/compensated.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Angles and velocities, with what rounding takes from the sums.
template <Separable Sys>
struct drift_kick_state {
  using S = typename Sys::scalar;
  static constexpr std::size_t freedom = degrees_of_freedom<Sys>;
  using half = vec<S, freedom>;

  compensated_point<half> theta, omega;

  PENDULA_INLINE void drift(S h) { theta = theta.moved_by(times(h, omega.head)); }
  PENDULA_INLINE void kick(const Sys& system, S t, S h) {
    omega = omega.moved_by(times(h, system.accelerations(t, theta.head)));
  }

  PENDULA_INLINE friend typename Sys::state head_of(const drift_kick_state& at) {
    typename Sys::state y;
    for (std::size_t i = 0; i < freedom; ++i) {
      y[i] = at.theta.head[i];
      y[freedom + i] = at.omega.head[i];
    }
    return y;
  }
  friend void retire_lane(drift_kick_state& at, int lane) {
    for (auto* each : {&at.theta, &at.omega})
      for (std::size_t i = 0; i < freedom; ++i) {
        set_lane(each->head[i], lane, 0.0);
        set_lane(each->tail[i], lane, 0.0);
      }
  }

 private:
  PENDULA_INLINE static half times(S h, half x) {
    for (S& each : x) each = h * each;
    return x;
  }
};

// What all methods made of them have in common.
struct splitting_method {
  static constexpr bool adaptive = false, symplectic = true;
  static constexpr facet needs = facet::separable;

  template <Separable Sys>
  PENDULA_INLINE static drift_kick_state<Sys> begin(const Sys& system, const typename Sys::state& y) {
    constexpr std::size_t freedom = degrees_of_freedom<Sys>;
    const typename Sys::state z = system.canonical(y);
    drift_kick_state<Sys> at;
    for (std::size_t i = 0; i < freedom; ++i) {
      at.theta.head[i] = z[i];
      at.omega.head[i] = z[freedom + i];
      at.theta.tail[i] = at.omega.tail[i] = typename Sys::scalar(0.0);
    }
    return at;
  }
  template <Separable Sys>
  PENDULA_INLINE static typename Sys::state state_of(const Sys& system, const drift_kick_state<Sys>& at) {
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
struct verlet_composition : splitting_method {
  static constexpr std::string_view name = tableau.name;
  static constexpr int order = tableau.order;
  static constexpr std::size_t steps = 2 * tableau.outer.size() + 1;
  static constexpr int evaluations_per_step = static_cast<int>(steps);
  static constexpr std::string_view source = tableau.source;

  // Half drifts of neighbours are one. A drift carries the time on, too.
  template <Separable Sys, class S = typename Sys::scalar>
  PENDULA_INLINE static drift_kick_state<Sys> step(const Sys& system, S t, drift_kick_state<Sys> at, S h) {
    const std::array<S, steps> part = parts_of_step<steps>(h, tableau.outer);
    const auto drift = [&](S by) {
      at.drift(by);
      t = t + by;
    };
    drift(S(0.5) * part[0]);
    for (std::size_t i = 0; i + 1 < steps; ++i) {
      at.kick(system, t, part[i]);
      drift(S(0.5) * (part[i] + part[i + 1]));
    }
    at.kick(system, t, part[steps - 1]);
    at.drift(S(0.5) * part[steps - 1]);
    return at;
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
