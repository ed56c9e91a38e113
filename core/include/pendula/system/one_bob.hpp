// A point mass on a massless rod: what the linear and the simple pendulum share.
#pragma once

#include "pendula/scalar/sincos.hpp"
#include "pendula/system/parameter.hpp"

namespace pendula {

struct one_bob {
  static constexpr std::array components{component{"theta", "rad", 0.5235987755982989,  // 30°
                                                   "angle from the downward vertical, counter-clockwise"},
                                         component{"omega", "rad/s", 0.0, "angular velocity"}};
  static constexpr std::array parameters{parameter{"length", "m", 1.0, false, "length from pivot to bob"}, gravity_row,
                                         parameter{"mass", "kg", 1.0, false, "mass of the bob"}};
  static constexpr std::array forms{form{"", "point mass on a massless rod", parameters}};

  template <class S>
  struct over {
    using scalar = S;
    static constexpr std::size_t dimension = 2;
    using state = vec<S, dimension>;

    S length, gravity, mass;
    S frequency_squared = gravity / length;

    S kinetic_energy(const state& y) const { return S(0.5) * mass * (length * y[1]) * (length * y[1]); }

    std::array<constant<S>, 2> constants() const {
      return {{{"natural_frequency_squared", frequency_squared}, {"energy_scale", mass * gravity * length}}};
    }

    std::array<vec<S, 2>, 1> positions(const state& y) const {
      const auto [s, c] = sincos(y[0]);
      return {{{length * s, -(length * c)}}};
    }
  };
};

}  // namespace pendula
