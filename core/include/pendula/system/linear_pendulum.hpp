// The linear pendulum, θ̈ = −(g/L) θ: the small-angle model, harmonic for every amplitude.
#pragma once

#include "pendula/system/one_bob.hpp"

namespace pendula {

struct linear_pendulum : one_bob {
  static constexpr std::string_view name = "linear";

  template <class S>
  struct over : one_bob::over<S> {
    using state = typename one_bob::over<S>::state;

    template <class T>
    PENDULA_INLINE T acceleration(T angle) const {
      return -(T(this->frequency_squared) * angle);
    }
    PENDULA_INLINE state rhs(const state& y) const { return {y[1], acceleration(y[0])}; }
    PENDULA_INLINE state canonical_rhs(const state& z) const { return rhs(z); }
    template <class T>
    PENDULA_INLINE posture<T> posture_at(const vec<T, 1>& angles) const {
      return {acceleration(angles[0])};
    }

    // that of the linear model itself, which it conserves
    S potential_energy(const state& y) const {
      return S(0.5) * this->mass * this->gravity * this->length * y[0] * y[0];
    }
  };

  template <class S>
  static over<S> make(std::size_t, const S* p) {
    return {{p[0], p[1], p[2]}};
  }
};

}  // namespace pendula
