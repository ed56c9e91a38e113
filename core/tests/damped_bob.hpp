// A pendulum that loses energy, for the tests: what an entry of the catalogue would say of itself, outside of it.
#pragma once

#include "pendula/system/one_bob_series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class damped_bob_series;

// θ̈ = −(g/L) sin θ − b/(m L²) ω, with friction b at the pivot.
struct damped_bob : one_bob {
  static constexpr std::string_view name = "damped";
  static constexpr capabilities can{.conservative = false,
                                    .autonomous = true,
                                    .closed_form = false,
                                    .period = false,
                                    .mapped = false,
                                    .periodic = true};
  static constexpr std::array parameters{
      one_bob::parameters[0], gravity_row, one_bob::parameters[2],
      parameter{"friction", "kg m^2/s", 0.1, range::not_negative, "torque of friction over velocity"}};
  static constexpr std::array forms{form{"", "point mass on a massless rod, with friction at the pivot", parameters}};

  template <class S>
  struct over : one_bob::over<S> {
    using state = typename one_bob::over<S>::state;
    using series = damped_bob_series<S>;

    S friction;
    S rate = friction / (this->mass * this->length * this->length);

    template <class T>
    PENDULA_INLINE configuration<T> configuration_at(const vec<T, 1>& angles) const {
      return {-(T(this->frequency_squared) * sincos(angles[0]).sin)};
    }
    // They depend on the velocity: there are no accelerations at an angle, and the energy does not separate.
    template <class T>
    PENDULA_INLINE vec<T, 1> forces(const T&, const configuration<T>& at, const vec<T, 1>& omega) const {
      return {at.acceleration - T(rate) * omega[0]};
    }
    PENDULA_INLINE state rhs(const S& t, const state& y) const {
      return {y[1], forces<S>(t, configuration_at<S>({y[0]}), {y[1]})[0]};
    }

    S potential_energy(const state& y) const { return this->mass * this->gravity * this->length * one_minus_cos(y[0]); }
    // What friction takes: the energy's rate of change with its sign turned.
    S power_lost(const state& y) const { return friction * y[1] * y[1]; }
  };

  template <class S>
  static over<S> make(std::size_t, const S* p) {
    return {{p[0], p[1], p[2]}, p[3]};
  }
};

// Of the simple pendulum, with ω' = −(g/L) s − b/(m L²) ω.
template <class S>
class damped_bob_series : public one_bob_series<S> {
 public:
  explicit damped_bob_series(int order)
      : one_bob_series<S>(order), sine_(this->velocity_.size()), cosine_(this->velocity_.size()) {}

  PENDULA_INLINE void expand(const damped_bob::over<S>& of, const head_and_tail<S>&, const vec<S, 2>& point,
                             const vec<S, 2>& tail, const S* inverse) {
    const auto [s, c] = sincos_with_tail(sincos(point[0]), tail[0]);
    S* const w = this->velocity_.data();
    sine_[0] = s;
    cosine_[0] = c;
    w[0] = point[1];
    for (int k = 0; k < this->order_; ++k) {
      S of_sine(0.0), of_cosine(0.0);
      for (int j = 0; j <= k; ++j) {
        of_sine = of_sine + sine_[j] * w[k - j];
        of_cosine = of_cosine + cosine_[j] * w[k - j];
      }
      w[k + 1] = -((of.frequency_squared * sine_[k] + of.rate * w[k]) * inverse[k + 1]);
      sine_[k + 1] = of_cosine * inverse[k + 1];
      cosine_[k + 1] = -(of_sine * inverse[k + 1]);
    }
  }

 private:
  std::vector<S> sine_, cosine_;
};

static_assert(!Separable<damped_bob::over<double>> && Analytic<damped_bob::over<double>>);

}  // namespace pendula::inline PENDULA_MACHINE
