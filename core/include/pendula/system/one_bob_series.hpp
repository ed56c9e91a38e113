// Taylor series of a motion of the simple pendulum, with ∗ for the Cauchy product: θ' = ω, ω' = −(g/L) s,
// s' = c ∗ ω, c' = −s ∗ ω for s, c = sin θ, cos θ (Jorba & Zou 2005, Exp. Math. 14, 99); and of the linear one, θ' = ω,
// ω' = −(g/L) θ.
#pragma once

#include <vector>

#include "pendula/system/linear_pendulum.hpp"
#include "pendula/system/series.hpp"
#include "pendula/system/simple_pendulum.hpp"

namespace pendula {

// What both have in common: the velocity's orders, and what follows from them.
template <class S>
class one_bob_series {
 public:
  // The order is even.
  explicit one_bob_series(int order) : order_(order), velocity_(static_cast<std::size_t>(order) + 1) {}

  PENDULA_INLINE S velocity(int, int k) const { return velocity_[k]; }

  // What is added to (θ, ω) in a time h: even and odd orders side by side.
  PENDULA_INLINE vec<S, 2> increment(S h, const S* inverse) const {
    const S square = h * h;
    S angle(0.0), angle_below(0.0), speed(0.0), speed_below(0.0);
    for (int k = order_; k >= 2; k -= 2) {
      angle = angle * square + velocity_[k - 1] * inverse[k];
      speed = speed * square + velocity_[k];
      angle_below = angle_below * square + velocity_[k - 2] * inverse[k - 1];
      speed_below = speed_below * square + velocity_[k - 1];
    }
    return {(angle * h + angle_below) * h, (speed * h + speed_below) * h};
  }

 protected:
  int order_;
  std::vector<S> velocity_;
};

template <class S>
class simple_pendulum_series : public one_bob_series<S> {
 public:
  using system = simple_pendulum::over<S>;

  explicit simple_pendulum_series(int order)
      : one_bob_series<S>(order), sine_(this->velocity_.size()), cosine_(this->velocity_.size()) {}

  // The motion from the point (θ, ω), whose angle goes on in `tail`. `inverse` holds 1/k at place k.
  PENDULA_INLINE void expand(const system& of, const vec<S, 2>& point, const vec<S, 2>& tail, const S* inverse) {
    const auto [s, c] = turned_by(sincos(point[0]), tail[0]);
    sine_[0] = s;
    cosine_[0] = c;
    this->velocity_[0] = point[1];
    for (int k = 0; k < this->order_; ++k) advance(of, k, inverse[k + 1]);
  }

 private:
  PENDULA_INLINE void advance(const system& of, int k, S inverse) {
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

template <class S>
class linear_pendulum_series : public one_bob_series<S> {
 public:
  using system = linear_pendulum::over<S>;
  using one_bob_series<S>::one_bob_series;

  PENDULA_INLINE void expand(const system& of, const vec<S, 2>& point, const vec<S, 2>&, const S* inverse) {
    S* const w = this->velocity_.data();
    w[0] = point[1];
    w[1] = -(of.frequency_squared * point[0]);
    for (int k = 1; k < this->order_; ++k)
      w[k + 1] = -(of.frequency_squared * (w[k - 1] * inverse[k]) * inverse[k + 1]);
  }
};

template <class S>
struct series_of<simple_pendulum::over<S>> {
  using type = simple_pendulum_series<S>;
};
template <class S>
struct series_of<linear_pendulum::over<S>> {
  using type = linear_pendulum_series<S>;
};

}  // namespace pendula
