// Taylor series of the driven pendulum (Jorba & Zou 2005, Exp. Math. 14, 99): that of the simple one,
//     ω' = −(m g c / I) s + drive + pivot ∗ (cos α c + sin α s) − b ω − r ω³ − σ (τc + d ω²),
// with σ = ±1 for the piece of the motion. What has a coefficient of zero is left out.
#pragma once

#include "pendula/scalar/machine.hpp"
#include "pendula/system/driven_pendulum.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// Orders of sine and cosine, for any scalar and, for one trajectory of doubles, in two lanes: the same operations on
// the same numbers.
template <class S>
struct sine_with_cosine {
  S sine, cosine;

  PENDULA_INLINE S first() const { return sine; }
  PENDULA_INLINE S second() const { return cosine; }
  PENDULA_INLINE static sine_with_cosine of(const S& s, const S& c) { return {s, c}; }
  PENDULA_INLINE friend sine_with_cosine operator+(const sine_with_cosine& a, const sine_with_cosine& b) {
    return {a.sine + b.sine, a.cosine + b.cosine};
  }
  PENDULA_INLINE friend sine_with_cosine operator*(const sine_with_cosine& a, const S& b) {
    return {a.sine * b, a.cosine * b};
  }
  // The next order: s' = c ω, c' = −s ω.
  PENDULA_INLINE sine_with_cosine integrated(const S& inverse) const { return {cosine * inverse, sine * -inverse}; }
};
template <>
struct sine_with_cosine<double> {
  pack<double, 2> both;

  PENDULA_INLINE double first() const { return both[0]; }
  PENDULA_INLINE double second() const { return both[1]; }
  PENDULA_INLINE static sine_with_cosine of(double s, double c) { return {lanes_of(s, c)}; }
  PENDULA_INLINE friend sine_with_cosine operator+(sine_with_cosine a, sine_with_cosine b) { return {a.both + b.both}; }
  PENDULA_INLINE friend sine_with_cosine operator*(sine_with_cosine a, double b) {
    return {a.both * pack<double, 2>(b)};
  }
  PENDULA_INLINE sine_with_cosine integrated(double inverse) const {
    return {rearranged<1, 0>(both) * lanes_of(inverse, -inverse)};
  }
};

}  // namespace detail

template <class S>
class driven_pendulum_series : public one_bob_series<S> {
 public:
  explicit driven_pendulum_series(int order)
      : one_bob_series<S>(order),
        turned_(this->velocity_.size()),
        square_(this->velocity_.size()),
        pivot_(this->velocity_.size()) {}

  PENDULA_INLINE void expand(const driven_pendulum::over<S>& of, const head_and_tail<S>& t, const vec<S, 2>& point,
                             const vec<S, 2>& tail, const S* inverse) {
    S* const w = this->velocity_.data();
    if (!present(of.senses[0])) return this->velocity_.assign(this->velocity_.size(), S(0.0));
    const auto [s, c] = sincos_with_tail(sincos(point[0]), tail[0]);
    turned_[0] = pair::of(s, c);
    w[0] = point[1];
    const bool driven = present(of.drive.amplitude), moved = present(of.pivot.amplitude);
    const bool cubic = present(of.cubic), squared = cubic || present(of.quadratic);
    harmonic_series<S> drive, pivot;
    if (driven) drive.start(of.drive, t);
    if (moved) pivot.start(of.pivot, t);
    for (int k = 0; k < this->order_; ++k) {
      S rate = -(of.frequency_squared * turned_[k].first());
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
  using pair = detail::sine_with_cosine<S>;

  // Order k + 1 of sine and cosine, from the middle of the product outward: the sums of the older terms are there when
  // the newest numbers come.
  PENDULA_INLINE void turn(int k, const S& inverse) {
    const S* const w = this->velocity_.data();
    pair newer = pair::of(S(0.0), S(0.0)), older = newer;
    for (int j = k / 2; j >= 1; --j) {
      older = older + turned_[j] * w[k - j];
      if (2 * j != k) newer = newer + turned_[k - j] * w[j];
    }
    pair sum = (older + newer) + turned_[0] * w[k];
    if (k > 0) sum = sum + turned_[k] * w[0];
    turned_[k + 1] = sum.integrated(inverse);
  }

  // Order k of what the pivot's motion adds.
  PENDULA_INLINE S moved_by(const driven_pendulum::over<S>& of, int k, const S& order) {
    pivot_[k] = order;
    pair sum = pair::of(S(0.0), S(0.0));
    for (int j = 0; j <= k; ++j) sum = sum + turned_[k - j] * pivot_[j];
    return of.across * sum.second() + of.along * sum.first();
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

  std::vector<pair> turned_;
  std::vector<S> square_, pivot_;
};

}  // namespace pendula::inline PENDULA_MACHINE
