// The linear pendulum, θ̈ = −(g/L) θ: the small-angle model, harmonic for every amplitude.
#pragma once

#include "pendula/scalar/sincos.hpp"
#include "pendula/system/simple_pendulum.hpp"

namespace pendula {

struct linear_pendulum {
  static constexpr std::string_view name = "linear";
  static constexpr auto components = simple_pendulum::components;
  static constexpr auto forms = simple_pendulum::forms;

  template <class S>
  struct over {
    using scalar = S;
    static constexpr std::size_t dimension = 2;
    using state = vec<S, dimension>;

    S length, gravity, mass;
    S frequency_squared = gravity / length;

    PENDULA_INLINE state rhs(const state& y) const { return {y[1], -(frequency_squared * y[0])}; }

    S kinetic_energy(const state& y) const { return S(0.5) * mass * (length * y[1]) * (length * y[1]); }
    // that of the linear model itself, which it conserves
    S potential_energy(const state& y) const { return S(0.5) * mass * gravity * length * y[0] * y[0]; }
    std::array<constant<S>, 2> constants() const {
      return {{{"natural_frequency_squared", frequency_squared}, {"energy_scale", mass * gravity * length}}};
    }

    std::array<vec<S, 2>, 1> positions(const state& y) const {
      const auto [s, c] = sincos(y[0]);
      return {{{length * s, -(length * c)}}};
    }
  };

  template <class S>
  static over<S> make(std::size_t, const S* p) {
    return {p[0], p[1], p[2]};
  }
};

}  // namespace pendula
