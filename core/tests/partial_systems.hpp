// Systems that lack one facet each, to see which methods still take them (facets.hpp).
#pragma once

#include "pendula/scalar/sincos.hpp"
#include "pendula/system/series.hpp"

namespace partial {

using namespace pendula;

// A damped and driven pendulum made autonomous the usual way: θ, ω, and the phase of the drive.
struct with_phase {
  using scalar = double;
  static constexpr std::size_t dimension = 3;
  using state = vec<double, 3>;

  state rhs(double, const state& y) const {
    return {y[1], -9.81 * sincos(y[0]).sin - 0.3 * y[1] + 1.5 * sincos(y[2]).cos, 2.0};
  }
  // all that a system with velocities would have, and more than it can
  state canonical(const state& y) const { return y; }
  state from_canonical(const state& y) const { return y; }
  double kinetic_energy(const state& y) const { return 0.5 * y[1] * y[1]; }
  double potential_energy(const state& y) const { return 9.81 * one_minus_cos(y[0]); }
  double energy_scale() const { return 9.81; }
  double largest_frequency_squared() const { return 9.81; }
};

// θ̈ = −sin θ, of which the others take what they have.
struct flow {
  using scalar = double;
  static constexpr std::size_t dimension = 2;
  using state = vec<double, 2>;

  state rhs(double, const state& y) const { return {y[1], -sincos(y[0]).sin}; }
};
template <class Below>
struct energetic : Below {
  double kinetic_energy(const flow::state& y) const { return 0.5 * y[1] * y[1]; }
  double potential_energy(const flow::state& y) const { return one_minus_cos(y[0]); }
  double energy_scale() const { return 1.0; }
  double largest_frequency_squared() const { return 1.0; }
};
template <class Below>
struct mechanical : Below {
  template <class T>
  struct configuration {
    T force;
  };

  flow::state canonical(const flow::state& y) const { return y; }
  flow::state from_canonical(const flow::state& y) const { return y; }
  template <class T>
  configuration<T> configuration_at(const vec<T, 1>& angles) const {
    return {-sincos(angles[0]).sin};
  }
  template <class T>
  vec<T, 1> velocities(const configuration<T>&, const vec<T, 1>& p) const {
    return p;
  }
  template <class T>
  vec<T, 1> forces(const T&, const configuration<T>& at, const vec<T, 1>&) const {
    return {at.force};
  }
};
// Canonical variables of doubles alone: the stages of an implicit step cannot go side by side.
struct of_doubles_alone : energetic<flow> {
  state canonical(const state& y) const { return y; }
  state from_canonical(const state& y) const { return y; }
  double configuration_at(const vec<double, 1>& angles) const { return -sincos(angles[0]).sin; }
  vec<double, 1> velocities(double, const vec<double, 1>& p) const { return p; }
  vec<double, 1> forces(double, double force, const vec<double, 1>&) const { return {force}; }
};
template <class Below>
struct separable : Below {
  template <class T>
  vec<T, 1> accelerations(const T&, const vec<T, 1>& angles) const {
    return {-sincos(angles[0]).sin};
  }
};

using without_energy = separable<mechanical<flow>>;
using without_canonical_variables = energetic<flow>;
using without_accelerations = energetic<mechanical<flow>>;
using without_series = separable<without_accelerations>;  // and without positions

}  // namespace partial
