// What a scalar, a system and a method are. Everything else in the core is written against these three.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

// Kernels are small and must be inlined into the loop that the compiler vectorises or pipelines; under a sanitizer
// they are not small.
#ifdef PENDULA_SANITIZED
#define PENDULA_INLINE inline
#else
#define PENDULA_INLINE [[gnu::always_inline]] inline
#endif

namespace pendula {

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

// A system over one scalar: constants, right-hand side and energies, and the same motion in canonical variables
// (angles…, momenta…). Separable: H = T(p) + V(θ).
template <class Sys>
concept SystemOver = requires(const Sys& system, const typename Sys::state& y) {
  { Sys::dimension } -> std::convertible_to<std::size_t>;
  { Sys::separable } -> std::convertible_to<bool>;
  { system.rhs(y) } -> std::same_as<typename Sys::state>;
  { system.canonical(y) } -> std::same_as<typename Sys::state>;
  { system.from_canonical(y) } -> std::same_as<typename Sys::state>;
  { system.canonical_rhs(y) } -> std::same_as<typename Sys::state>;
  { system.kinetic_energy(y) } -> std::same_as<typename Sys::scalar>;
  { system.potential_energy(y) } -> std::same_as<typename Sys::scalar>;
  system.positions(y);
  system.constants();
};

// An entry of the catalogue's list of systems: name, parameter rows, and the system over any scalar.
template <class T>
concept System = SystemOver<typename T::template over<double>> && requires(const double* p) {
  { T::name } -> std::convertible_to<std::string_view>;
  T::components;
  T::forms;
  { T::template make<double>(std::size_t{}, p) } -> std::same_as<typename T::template over<double>>;
};

// An entry of the catalogue's list of methods. One that iterates has no fixed number of evaluations and says 0.
template <class T>
concept Method = requires {
  { T::name } -> std::convertible_to<std::string_view>;
  { T::order } -> std::convertible_to<int>;
  { T::evaluations_per_step } -> std::convertible_to<int>;
  { T::adaptive } -> std::convertible_to<bool>;
  { T::symplectic } -> std::convertible_to<bool>;
  { T::source } -> std::convertible_to<std::string_view>;
};

// A method with a system it takes: from a state it begins with what it carries from step to step, its state among it.
template <class T, class Sys>
concept StepsOver = SystemOver<Sys> && T::template takes<Sys> &&
                    requires(const Sys& system, const typename Sys::state& y, const typename Sys::scalar& h) {
                      { T::step(system, T::begin(system, y), h) } -> std::same_as<decltype(T::begin(system, y))>;
                      { T::state_of(system, T::begin(system, y)) } -> std::same_as<typename Sys::state>;
                    };

}  // namespace pendula
