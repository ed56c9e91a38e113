// Taylor series of the variations of a motion of the double pendulum: small changes of it, to first order. Linearised
// in canonical variables, with X = s ∗ ω1, Y = s ∗ ω2, G = c ∗ ω1 ∗ ω2 of the motion's own series
// (double_pendulum_series.hpp) and δ of a difference of angles,
//     A δω1 + C c ∗ δω2 = δp1 + C Y ∗ δδ,   C c ∗ δω1 + B δω2 = δp2 + C X ∗ δδ,   δθi' = δωi,
//     δp1' = −C Q − D cos θ1 ∗ δθ1,   δp2' = C Q − E cos θ2 ∗ δθ2,   Q = G ∗ δδ + Y ∗ δω1 + X ∗ δω2:
// nine products a variation, where numbers that carry derivatives take eighteen.
#pragma once

#include <vector>

#include "pendula/system/double_pendulum.hpp"

namespace pendula::inline PENDULA_MACHINE {

// A double pendulum whose series keeps the products that those of variations need.
template <class S>
struct varied_double_pendulum : double_pendulum::over<S> {
  using series = double_pendulum_series<S, true>;

  varied_double_pendulum() = default;
  varied_double_pendulum(const double_pendulum::over<S>& system) : double_pendulum::over<S>(system) {}

  // (θ1, θ2, p1, p2) of a variation of (θ1, θ2, ω1, ω2), at a state.
  vec<S, 4> canonical_variation(const vec<S, 4>& y, const vec<S, 4>& d) const {
    const auto at = this->template configuration_at<S>({y[0], y[1]});
    const S turned = at.turning * (d[0] - d[1]);
    return {d[0], d[1], this->A * d[2] + at.coupling * d[3] - turned * y[3],
            at.coupling * d[2] + this->B * d[3] - turned * y[2]};
  }
  // And back, at a point in canonical variables.
  vec<S, 4> variation_of(const vec<S, 4>& z, const vec<S, 4>& d) const {
    const auto at = this->template configuration_at<S>({z[0], z[1]});
    const auto omega = this->template velocities<S>(at, {z[2], z[3]});
    const S turned = at.turning * (d[0] - d[1]);
    const auto changed = this->template velocities<S>(at, {d[2] + turned * omega[1], d[3] + turned * omega[0]});
    return {d[0], d[1], changed[0], changed[1]};
  }
};

// Of n variations of the motions in the lanes of S.
template <class S, int n>
class double_pendulum_variations {
 public:
  using series = double_pendulum_series<S, true>;
  using variation = vec<S, 4>;  // of (θ1, θ2, p1, p2)

  explicit double_pendulum_variations(int order)
      : orders_(static_cast<std::size_t>(order) + 1), turning_(orders_.size()) {}

  PENDULA_INLINE void expand(const double_pendulum::over<S>& of, const series& motion,
                             const std::array<variation, n>& start, const S* inverse) {
    const auto& first = motion.order(0).factor;
    const S coupling = first.coupling_cosine(), sine = first.coupling_sine();
    const S of_determinant = S(1.0) / (of.determinant_floor + sine * sine);
    const detail::double_inverse<S> mass{of.B * of_determinant, -(coupling * of_determinant), of.A * of_determinant};
    for (int i = 0; i < n; ++i) {
      const variation& d = start[i];
      orders_[0][i] = {d[0], d[1], d[0] - d[1], S(0.0), S(0.0), d[2], d[3]};
    }
    const int last = static_cast<int>(orders_.size()) - 1;  // even
    for (int k = 0; k < last; ++k) turning_[k] = turning_of(motion, k);
    for (int k = 0; k < last; k += 2)
      for (int i = 0; i < n; ++i) advance_twice(motion, mass, k, i, inverse);
  }

  // What is added to a variation in a time h.
  PENDULA_INLINE variation increment(int i, S h) const {
    variation sum{S(0.0), S(0.0), S(0.0), S(0.0)};
    for (std::size_t k = orders_.size() - 1; k >= 1; --k) {
      const one_variation& d = orders_[k][i];
      sum = {(sum[0] + d.angle1) * h, (sum[1] + d.angle2) * h, (sum[2] + d.p1) * h, (sum[3] + d.p2) * h};
    }
    return sum;
  }
  // A variation of (θ1, θ2, ω1, ω2) at a time h: the velocities from their own series.
  PENDULA_INLINE variation at(int i, S h) const {
    const std::size_t last = orders_.size() - 1;
    variation sum{orders_[last][i].angle1, orders_[last][i].angle2, S(0.0), S(0.0)};
    for (std::size_t k = last; k-- > 0;) {
      const one_variation& d = orders_[k][i];
      sum = {sum[0] * h + d.angle1, sum[1] * h + d.angle2, sum[2] * h + d.w1, sum[3] * h + d.w2};
    }
    return sum;
  }

 private:
  struct one_variation {
    S angle1, angle2, difference, w1, w2, p1, p2;
  };

  // Order k of C c ∗ ω1 ∗ ω2.
  PENDULA_INLINE static S turning_of(const series& motion, int k) {
    S sum(0.0);
    for (int j = 0; j <= k; ++j) sum = sum + motion.order(j).kept.cosine_first * motion.velocity(1, k - j);
    return sum;
  }

  // An order of the motion, as the variations take it.
  struct of_motion {
    S cosine, sine_first, sine_second, turning, cosine1, cosine2;
  };
  PENDULA_INLINE of_motion order_of(const series& motion, int j) const {
    const auto& o = motion.order(j);
    return {o.factor.coupling_cosine(), o.sine_first, o.kept.sine_second, turning_[j], o.factor.first_cosine(),
            o.factor.second_cosine()};
  }

  // The sums of products that an order is made of.
  struct sums {
    S first, second, exchange{0.0}, pull1{0.0}, pull2{0.0};

    PENDULA_INLINE void add(const of_motion& o, const one_variation& d) {
      add_angles(o, d);
      first = first - o.cosine * d.w2;
      second = second - o.cosine * d.w1;
      add_exchange(o, d);
    }
    PENDULA_INLINE void add_angles(const of_motion& o, const one_variation& d) {
      first = first + o.sine_second * d.difference;
      second = second + o.sine_first * d.difference;
      exchange = exchange + o.turning * d.difference;
      pull1 = pull1 + o.cosine1 * d.angle1;
      pull2 = pull2 + o.cosine2 * d.angle2;
    }
    PENDULA_INLINE void add_exchange(const of_motion& o, const one_variation& d) {
      exchange = exchange + (o.sine_second * d.w1 + o.sine_first * d.w2);
    }
  };

  // Orders k and k + 1 of the velocities and the next of the rest, for k even: together they load each number once.
  PENDULA_INLINE void advance_twice(const series& motion, const detail::double_inverse<S>& mass, int k, int i,
                                    const S* inverse) {
    sums now{orders_[k][i].p1, orders_[k][i].p2}, later{S(0.0), S(0.0)};
    of_motion o = order_of(motion, 1);
    for (int j = 1; j <= k; ++j) {
      const one_variation& d = orders_[k - j][i];
      now.add(o, d);
      o = order_of(motion, j + 1);
      later.add(o, d);
    }
    const of_motion zeroth = order_of(motion, 0);
    finish(zeroth, mass, now, k, i, inverse[k + 1]);
    later.first = later.first + orders_[k + 1][i].p1;
    later.second = later.second + orders_[k + 1][i].p2;
    later.add(order_of(motion, 1), orders_[k][i]);
    finish(zeroth, mass, later, k + 1, i, inverse[k + 2]);
  }
  PENDULA_INLINE void finish(const of_motion& zeroth, const detail::double_inverse<S>& mass, sums sum, int k, int i,
                             S inverse) {
    one_variation& mine = orders_[k][i];
    sum.add_angles(zeroth, mine);
    mine.w1 = mass.i11 * sum.first + mass.i12 * sum.second;
    mine.w2 = mass.i12 * sum.first + mass.i22 * sum.second;
    sum.add_exchange(zeroth, mine);
    one_variation& next = orders_[k + 1][i];
    next.angle1 = mine.w1 * inverse;
    next.angle2 = mine.w2 * inverse;
    next.difference = next.angle1 - next.angle2;
    next.p1 = (sum.exchange + sum.pull1) * -inverse;
    next.p2 = (sum.exchange - sum.pull2) * inverse;
  }

  std::vector<std::array<one_variation, n>> orders_;
  std::vector<S> turning_;
};

}  // namespace pendula::inline PENDULA_MACHINE
