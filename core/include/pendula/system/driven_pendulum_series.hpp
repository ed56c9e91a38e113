// Taylor series of the driven pendulum (Jorba & Zou 2005, Exp. Math. 14, 99): that of the simple one,
//     ω' = −(m g c / I) s + drive + pivot ∗ (cos α c + sin α s) − b ω − r ω³ − σ (τc + d ω²),
// with σ = ±1 for the piece of the motion. What has a coefficient of zero is left out.
#pragma once

#include "pendula/system/driven_pendulum.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class driven_pendulum_series : public one_bob_series<S> {
 public:
  explicit driven_pendulum_series(int order)
      : one_bob_series<S>(order),
        sine_(this->velocity_.size()),
        cosine_(this->velocity_.size()),
        square_(this->velocity_.size()),
        pivot_(this->velocity_.size()) {}

  PENDULA_INLINE void expand(const driven_pendulum::over<S>& of, const head_and_tail<S>& t, const vec<S, 2>& point,
                             const vec<S, 2>& tail, const S* inverse) {
    S* const w = this->velocity_.data();
    if (!present(of.senses[0])) return this->velocity_.assign(this->velocity_.size(), S(0.0));
    const auto [s, c] = sincos_with_tail(sincos(point[0]), tail[0]);
    sine_[0] = s;
    cosine_[0] = c;
    w[0] = point[1];
    const bool driven = present(of.drive.amplitude), moved = present(of.pivot.amplitude);
    const bool cubic = present(of.cubic), squared = cubic || present(of.quadratic);
    harmonic_series<S> drive(of.drive, t), pivot(of.pivot, t);
    for (int k = 0; k < this->order_; ++k) {
      S rate = -(of.frequency_squared * sine_[k]);
      if (k == 0 && present(of.coulomb)) rate = rate - of.senses[0] * of.coulomb;
      if (driven) rate = rate + drive.order();
      if (moved) rate = rate + moved_by(of, k, pivot.order());
      if (present(of.viscous)) rate = rate - of.viscous * w[k];
      if (squared) rate = rate - dragged(of, k, cubic);
      w[k + 1] = rate * inverse[k + 1];
      turn(k, inverse[k + 1]);
      if (driven) drive.advance(inverse[k + 1]);
      if (moved) pivot.advance(inverse[k + 1]);
    }
  }

 private:
  // Order k + 1 of sine and cosine; terms with the newest numbers come last: the others need not wait.
  PENDULA_INLINE void turn(int k, const S& inverse) {
    const S* const w = this->velocity_.data();
    S of_sine(0.0), of_cosine(0.0);
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
    sine_[k + 1] = of_cosine * inverse;
    cosine_[k + 1] = -(of_sine * inverse);
  }

  // Order k of what the pivot's motion adds.
  PENDULA_INLINE S moved_by(const driven_pendulum::over<S>& of, int k, const S& order) {
    pivot_[k] = order;
    S of_sine(0.0), of_cosine(0.0);
    for (int j = 0; j <= k; ++j) {
      of_sine = of_sine + pivot_[j] * sine_[k - j];
      of_cosine = of_cosine + pivot_[j] * cosine_[k - j];
    }
    return of.across * of_cosine + of.along * of_sine;
  }

  // Order k of σ d ω² + r ω³.
  PENDULA_INLINE S dragged(const driven_pendulum::over<S>& of, int k, bool cubic) {
    const S* const w = this->velocity_.data();
    S of_square(0.0), of_cube(0.0);
    for (int j = 0; j <= k; ++j) of_square = of_square + w[j] * w[k - j];
    square_[k] = of_square;
    if (cubic)
      for (int j = 0; j <= k; ++j) of_cube = of_cube + square_[j] * w[k - j];
    return of.senses[0] * of.quadratic * of_square + of.cubic * of_cube;
  }

  std::vector<S> sine_, cosine_, square_, pivot_;
};

}  // namespace pendula::inline PENDULA_MACHINE
