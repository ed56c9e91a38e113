// The simple pendulum, θ̈ = −(g/L) sin θ, any angle: Herrera et al. (2024), eq. 5.
#pragma once

#include "pendula/system/one_bob_series.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class simple_pendulum_series;

struct simple_pendulum : one_bob {
  static constexpr std::string_view name = "simple";
  static constexpr capabilities can{
      .conservative = true, .autonomous = true, .closed_form = true, .period = true, .mapped = false, .periodic = true};

  template <class S>
  struct over : one_bob::over<S> {
    using state = typename one_bob::over<S>::state;
    using series = simple_pendulum_series<S>;

    template <class T>
    PENDULA_INLINE vec<T, 1> accelerations(const T&, const vec<T, 1>& angles) const {
      return {-(T(this->frequency_squared) * sincos(angles[0]).sin)};
    }
    PENDULA_INLINE state rhs(const S& t, const state& y) const { return {y[1], accelerations<S>(t, {y[0]})[0]}; }
    template <class T>
    PENDULA_INLINE configuration<T> configuration_at(const vec<T, 1>& angles) const {
      return {accelerations<T>(T(0.0), angles)[0]};
    }

    S potential_energy(const state& y) const {  // eq. 4, with the L it lost
      return this->mass * this->gravity * this->length * one_minus_cos(y[0]);
    }
  };

  template <class S>
  static over<S> make(std::size_t, const S* p) {
    return {{p[0], p[1], p[2]}};
  }
};

// With ∗ for the Cauchy product: θ' = ω, ω' = −(g/L) s, s' = c ∗ ω, c' = −s ∗ ω for s, c = sin θ, cos θ (Jorba & Zou
// 2005, Exp. Math. 14, 99).
template <class S>
class simple_pendulum_series : public one_bob_series<S> {
 public:
  explicit simple_pendulum_series(int order)
      : one_bob_series<S>(order), sine_(this->velocity_.size()), cosine_(this->velocity_.size()) {}

  PENDULA_INLINE void expand(const simple_pendulum::over<S>& of, const head_and_tail<S>&, const vec<S, 2>& point,
                             const vec<S, 2>& tail, const S* inverse) {
    const auto [s, c] = sincos_with_tail(sincos(point[0]), tail[0]);
    sine_[0] = s;
    cosine_[0] = c;
    this->velocity_[0] = point[1];
    for (int k = 0; k < this->order_; ++k) advance(of, k, inverse[k + 1]);
  }

 private:
  PENDULA_INLINE void advance(const simple_pendulum::over<S>& of, int k, S inverse) {
    const S* const w = this->velocity_.data();
    S of_sine(0.0), of_cosine(0.0);
    // terms with the newest numbers come last: the others need not wait
    for (int j = 1; j < k; ++j) {
      of_sine = of_sine + sine_[j] * w[k - j];
      of_cosine = of_cosine + cosine_[j] * w[k - j];
    }
    of_sine = of_sine + sine_[0] * w[k];
    of_cosine = of_cosine + cosine_[0] * w[k];
    if (k > 0) {
      of_sine = of_sine + sine_[k] * w[0];
      of_cosine = of_cosine + cosine_[k] * w[0];
    }
    this->velocity_[k + 1] = -(of.frequency_squared * sine_[k] * inverse);
    sine_[k + 1] = of_cosine * inverse;
    cosine_[k + 1] = -(of_sine * inverse);
  }

  std::vector<S> sine_, cosine_;
};

}  // namespace pendula::inline PENDULA_MACHINE
