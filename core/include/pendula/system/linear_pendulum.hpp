// The linear pendulum, θ̈ = −(g/L) θ: the small-angle model, harmonic for every amplitude.
#pragma once

#include "pendula/system/one_bob_series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class linear_pendulum_series;

struct linear_pendulum : one_bob {
  static constexpr std::string_view name = "linear";
  static constexpr capabilities can{.conservative = true,
                                    .autonomous = true,
                                    .closed_form = true,
                                    .period = true,
                                    .mapped = false,
                                    .periodic = false};

  template <class S>
  struct over : one_bob::over<S> {
    using state = typename one_bob::over<S>::state;
    using series = linear_pendulum_series<S>;

    template <class T>
    PENDULA_INLINE vec<T, 1> accelerations(const T&, const vec<T, 1>& angles) const {
      return {-(T(this->frequency_squared) * angles[0])};
    }
    PENDULA_INLINE state rhs(const S& t, const state& y) const { return {y[1], accelerations<S>(t, {y[0]})[0]}; }
    template <class T>
    PENDULA_INLINE configuration<T> configuration_at(const vec<T, 1>& angles) const {
      return {accelerations<T>(T(0.0), angles)[0]};
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

// θ' = ω, ω' = −(g/L) θ.
template <class S>
class linear_pendulum_series : public one_bob_series<S> {
 public:
  using one_bob_series<S>::one_bob_series;

  PENDULA_INLINE void expand(const linear_pendulum::over<S>& of, const head_and_tail<S>&, const vec<S, 2>& point,
                             const vec<S, 2>&, const S* inverse) {
    S* const w = this->velocity_.data();
    w[0] = point[1];
    w[1] = -(of.frequency_squared * point[0] * inverse[1]);
    for (int k = 1; k < this->order_; ++k)
      w[k + 1] = -(of.frequency_squared * (w[k - 1] * inverse[k]) * inverse[k + 1]);
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
