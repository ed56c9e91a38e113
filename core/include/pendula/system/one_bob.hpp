// A point mass on a massless rod: what the linear and the simple pendulum share.
#pragma once

#include "pendula/description.hpp"
#include "pendula/scalar/sincos.hpp"

namespace pendula::inline PENDULA_MACHINE {

struct one_bob {
  static constexpr std::array components{component{"theta", "rad", 0.5235987755982989,  // 30°
                                                   "angle from the downward vertical, counter-clockwise"},
                                         component{"omega", "rad/s", 0.0, "angular velocity"}};
  static constexpr std::array parameters{parameter{"length", "m", 1.0, range::positive, "length from pivot to bob"},
                                         gravity_row, parameter{"mass", "kg", 1.0, range::positive, "mass of the bob"}};
  static constexpr std::array forms{form{"", "point mass on a massless rod", parameters}};

  // All that the canonical equations need of the angle. T is the system's scalar or lanes of it.
  template <class T>
  struct configuration {
    T acceleration;
  };

  template <class S>
  struct over {
    using scalar = S;
    static constexpr std::size_t dimension = 2;
    using state = vec<S, dimension>;

    S length, gravity, mass;
    S frequency_squared = gravity / length;

    // The canonical equations, with p = ω: the momentum m L² ω up to a constant factor, which changes no motion.
    template <class T>
    PENDULA_INLINE vec<T, 1> velocities(const configuration<T>&, const vec<T, 1>& p) const {
      return p;
    }
    template <class T>
    PENDULA_INLINE vec<T, 1> forces(const T&, const configuration<T>& at, const vec<T, 1>&) const {
      return {at.acceleration};
    }
    PENDULA_INLINE state canonical(const state& y) const { return y; }
    PENDULA_INLINE state from_canonical(const state& z) const { return z; }

    S kinetic_energy(const state& y) const { return S(0.5) * mass * (length * y[1]) * (length * y[1]); }

    std::array<constant<S>, 2> constants() const {
      return {{{"natural_frequency_squared", frequency_squared}, {"energy_scale", energy_scale()}}};
    }

    S energy_scale() const { return mass * gravity * length; }
    vec<S, 1> lengths() const { return {length}; }
    S largest_frequency_squared() const { return frequency_squared; }

    std::array<vec<S, 2>, 1> positions(const state& y) const {
      const auto [s, c] = sincos(y[0]);
      return {{{length * s, -(length * c)}}};
    }
  };
};

}  // namespace pendula::inline PENDULA_MACHINE
