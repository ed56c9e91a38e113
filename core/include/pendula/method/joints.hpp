// Which way the joints of a system with friction slip, or that they stick.
#pragma once

#include <cmath>

#include "pendula/concepts.hpp"
#include "pendula/scalar/product.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// The relative velocity in a joint.
template <class State>
auto joint_velocity(const State& y, int joint) {
  const auto first = y.size() / 2 + static_cast<std::size_t>(joint);
  return joint == 0 ? y[first] : y[first] - y[first - 1];
}

// How far the senses of the joints at rest are from what their torques and accelerations allow; 0: not at all.
template <Piecewise Sys>
double violation(const Sys& system, const head_and_tail<typename Sys::scalar>& t, const typename Sys::state& y) {
  const auto [torques, accelerations] = system.joints_at(t, y);
  const auto holding = system.holding();
  const auto switching = system.switching();
  double most = 0.0;
  for (std::size_t j = 0; j < Sys::joints; ++j) {
    const double sense = rough(system.senses[j]);
    if (!switching[j] || rough(joint_velocity(y, static_cast<int>(j))) != 0.0) continue;
    const double beyond =
        sense == 0.0 ? std::fabs(rough(torques[j])) - rough(holding[j]) : -sense * rough(accelerations[j]);
    most = std::max(most, beyond);
  }
  return most;
}

}  // namespace detail

// Which way each joint goes from a state at time t: on where it moves; at rest, that of the senses which torques and
// accelerations allow, sticking first. `given[j]`: a sense that is known already, or NaN.
template <Piecewise Sys>
auto senses_at(Sys system, const head_and_tail<typename Sys::scalar>& t, const typename Sys::state& y,
               const std::array<double, Sys::joints>& given) {
  using S = typename Sys::scalar;
  constexpr std::array<double, 3> choices{0.0, 1.0, -1.0};
  const auto switching = system.switching();
  const auto holding = system.holding();
  auto best = system.senses;
  double least = HUGE_VAL;
  for (std::size_t n = 0, all = Sys::joints == 1 ? 3 : 9; n < all; ++n) {
    bool possible = true;
    for (std::size_t j = 0; j < Sys::joints; ++j) {
      const double velocity = rough(detail::joint_velocity(y, static_cast<int>(j)));
      const double choice = choices[j == 0 ? n % 3 : n / 3];
      const double known = !switching[j] ? 1.0 : velocity != 0.0 ? std::copysign(1.0, velocity) : given[j];
      possible = possible && (std::isnan(known) ? choice != 0.0 || rough(holding[j]) > 0.0 : choice == known);
      system.senses[j] = S(choice);
    }
    if (!possible) continue;
    const double beyond = detail::violation(system, t, y);
    if (beyond < least) best = system.senses, least = beyond;
  }
  return best;
}

// What a stepper keeps of the joints, and what its system is told of them; nothing of a system without friction.
template <class Sys>
struct joints_of {
  void start(Sys&, const typename Sys::scalar&, const typename Sys::state&) {}
  void tell(Sys&) const {}
  void move_on() {}
};

template <Piecewise Sys>
struct joints_of<Sys> {
  using S = typename Sys::scalar;

  vec<S, Sys::joints> senses;
  vec<S, Sys::joints> resting;  // 1 for a joint at rest just now, 2 where it is known which way it goes, else 0

  void start(Sys& system, const S& t, const typename Sys::state& y) {
    std::array<double, Sys::joints> open;
    open.fill(__builtin_nan(""));
    for (std::size_t j = 0; j < Sys::joints; ++j)
      resting[j] = S(rough(detail::joint_velocity(y, static_cast<int>(j))) == 0.0 ? 1.0 : 0.0);
    senses = senses_at(system, {t, S(0.0)}, y, open);
    tell(system);
  }
  void tell(Sys& system) const { system.senses = senses; }
  void move_on() { resting.fill(S(0.0)); }
};

}  // namespace pendula::inline PENDULA_MACHINE
