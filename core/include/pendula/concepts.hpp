// What a scalar, a system and a method are. Everything else in the core is written against these.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

#include "pendula/build.hpp"

namespace pendula::inline PENDULA_MACHINE {

// A state is (angles…, angular velocities…), in radians and radians per second.
template <class S, std::size_t dimension>
using vec = std::array<S, dimension>;

// A number the physics can be written over: double, lanes of doubles, or more digits.
template <class S>
concept Scalar = std::constructible_from<S, double> && requires(S a, S b) {
  { a + b } -> std::convertible_to<S>;
  { a - b } -> std::convertible_to<S>;
  { a * b } -> std::convertible_to<S>;
  { a / b } -> std::convertible_to<S>;
  { -a } -> std::convertible_to<S>;
};

// The facets of a system over one scalar. A method names the one it needs (facets.hpp), and each facet names every
// member that the code behind it calls. Time is the second's plain scalar everywhere; a system that does not depend on
// it ignores it, and pays nothing.

// y' = f(t, y).
template <class Sys>
concept Flow =
    Scalar<typename Sys::scalar> && std::same_as<typename Sys::state, vec<typename Sys::scalar, Sys::dimension>> &&
    requires(const Sys& system, const typename Sys::scalar& t, const typename Sys::state& y) {
      { system.rhs(t, y) } -> std::same_as<typename Sys::state>;
    };

// As many velocities as angles: the state's two halves.
template <class Sys>
concept SecondOrder = Flow<Sys> && Sys::dimension % 2 == 0;

template <class Sys>
struct halves_of {
  static_assert(Sys::dimension % 2 == 0, "a mechanical system has as many velocities as angles: an even dimension");
  static constexpr std::size_t size = Sys::dimension / 2;
};
template <class Sys>
inline constexpr std::size_t degrees_of_freedom = halves_of<Sys>::size;

// With energies, and the scales that errors and steps are measured by: an energy that is not zero, and the square of
// the largest frequency of small oscillations.
template <class Sys>
concept Energetic = SecondOrder<Sys> && requires(const Sys& system, const typename Sys::state& y) {
  { system.kinetic_energy(y) } -> std::same_as<typename Sys::scalar>;
  { system.potential_energy(y) } -> std::same_as<typename Sys::scalar>;
  { system.energy_scale() } -> std::same_as<typename Sys::scalar>;
  { system.largest_frequency_squared() } -> std::same_as<typename Sys::scalar>;
};

// The canonical equations over numbers T: `configuration_at` works out once what the velocities and the generalised
// forces need of the angles.
template <class Sys, class T>
concept CanonicalOver = requires(const Sys& system, const T& t, const vec<T, Sys::dimension / 2>& half) {
  { system.velocities(system.configuration_at(half), half) } -> std::same_as<std::remove_cvref_t<decltype(half)>>;
  { system.forces(t, system.configuration_at(half), half) } -> std::same_as<std::remove_cvref_t<decltype(half)>>;
};

template <class T, int W>
struct pack;  // lanes: scalar/pack.hpp

// A state and canonical variables (angles…, momenta…), in which the Taylor series is worked out, and back.
template <class Sys>
concept Canonical = SecondOrder<Sys> && requires(const Sys& system, const typename Sys::state& y) {
  { system.canonical(y) } -> std::same_as<typename Sys::state>;
  { system.from_canonical(y) } -> std::same_as<typename Sys::state>;
};

// The same motion in those. Of one trajectory of doubles the stages of an implicit
// step lie side by side, in lanes: its equations are asked for over these, too.
template <class Sys>
concept Mechanical = Canonical<Sys> && CanonicalOver<Sys, typename Sys::scalar> &&
                     (!std::same_as<typename Sys::scalar, double> || CanonicalOver<Sys, pack<double, 2>>);

// H = T(p) + V(t, θ), with momenta in units in which they are the velocities.
template <class Sys>
concept Separable = Mechanical<Sys> && requires(const Sys& system, const typename Sys::scalar& t,
                                                const vec<typename Sys::scalar, Sys::dimension / 2>& angles) {
  { system.accelerations(t, angles) } -> std::same_as<std::remove_cvref_t<decltype(angles)>>;
};

// With a place for each rod's end, and the rods' lengths.
template <class Sys>
concept Positioned = SecondOrder<Sys> && requires(const Sys& system, const typename Sys::state& y) {
  { system.lengths() } -> std::same_as<vec<typename Sys::scalar, Sys::dimension / 2>>;
  { system.positions(y) } -> std::same_as<std::array<vec<typename Sys::scalar, 2>, Sys::dimension / 2>>;
};

// Of the joints of a system with friction: the torque that friction has to balance where a joint is held, and the
// relative acceleration of each.
template <class S, std::size_t joints>
struct joint_motion {
  vec<S, joints> torques, accelerations;
};

// With friction that changes from piece to piece of the motion (drive/pieces.hpp): `senses` say which way each joint
// slips, 1 or −1, or that it sticks, 0, and `rhs_in_piece` keeps to them. `driven`: the torques change at rest, too.
// `holding` is the torque up to which each joint can stick, `switching` whether its friction changes at all, in the
// units of `joints_at`.
template <class Sys>
concept Piecewise =
    Energetic<Sys> && requires(Sys& system, const typename Sys::scalar& t, const typename Sys::state& y) {
      { system.senses } -> std::convertible_to<vec<typename Sys::scalar, Sys::joints>>;
      { system.rhs_in_piece(t, y) } -> std::same_as<typename Sys::state>;
      { system.holding() } -> std::same_as<vec<typename Sys::scalar, Sys::joints>>;
      { system.switching() } -> std::same_as<std::array<bool, Sys::joints>>;
      { system.driven() } -> std::same_as<bool>;
      { system.joints_at({t, t}, y) } -> std::same_as<joint_motion<typename Sys::scalar, Sys::joints>>;
      { system.with_joint_at_rest(y, 0) } -> std::same_as<typename Sys::state>;
    };

// Whose energy changes: by the powers of what does work, the first `works` of them, and of what turns it into heat [W].
template <class Sys>
concept Dissipative =
    Energetic<Sys> && requires(const Sys& system, const typename Sys::scalar& t, const typename Sys::state& y) {
      { Sys::power_names[0] } -> std::convertible_to<std::string_view>;
      { Sys::works } -> std::convertible_to<std::size_t>;
      { system.powers({t, t}, y) } -> std::same_as<vec<typename Sys::scalar, Sys::power_names.size()>>;
    };

// A method with a system it takes: from a state it begins with what it carries from step to step, its state among it.
template <class Method, class Sys>
concept StepsOver = Flow<Sys> && requires(const Sys& system, const typename Sys::state& y,
                                          const typename Sys::scalar& t, const typename Sys::scalar& h) {
  { Method::step(system, t, Method::begin(system, y), h) } -> std::same_as<decltype(Method::begin(system, y))>;
  { Method::state_of(system, Method::begin(system, y)) } -> std::same_as<typename Sys::state>;
};

}  // namespace pendula::inline PENDULA_MACHINE
