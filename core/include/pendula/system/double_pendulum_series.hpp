// Taylor series of a motion of the double pendulum, order by order (Jorba & Zou 2005, Exp. Math. 14, 99). In canonical
// variables and with ∗ for the Cauchy product,
//     θ_i' = ω_i,   p1' = −C F − D s1,   p2' = C F − E s2,   F = s ∗ ω1 ∗ ω2,
//     s_i' = c_i ∗ ω_i,   c_i' = −s_i ∗ ω_i,   s' = c ∗ (ω1 − ω2),   c' = −s ∗ (ω1 − ω2),
// where s, c are sine and cosine of δ = θ1 − θ2 and the velocities follow at each order k from
//     A ω1_k + C c_0 ω2_k = p1_k − C Σ_{j≥1} c_j ω2_{k−j},   C c_0 ω1_k + B ω2_k = p2_k − C Σ_{j≥1} c_j ω1_{k−j}:
// the matrix is that of order 0. Sines and cosines are carried times D, E and C, which saves those products.
#pragma once

#include <vector>

#include "pendula/system/double_pendulum.hpp"
#include "pendula/system/double_pendulum_products.hpp"
#include "pendula/system/series.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Of an order, what the series of the motion's variations needs beyond it.
template <class S>
struct double_kept_products {
  S sine_second, cosine_first;  // C s ∗ ω2 and C c ∗ ω1
};
struct nothing_kept {};

template <class S, bool keeps_products>
class double_pendulum_series {
 public:
  // The order is even.
  explicit double_pendulum_series(int order) : orders_(static_cast<std::size_t>(order) + 1) {}

  // From a point (θ1, θ2, p1, p2).
  PENDULA_INLINE void expand(const double_pendulum::over<S>& of, const head_and_tail<S>&, const vec<S, 4>& point,
                             const vec<S, 4>& tail, const S* inverse) {
    expand_with(of, point, tail, inverse, [](int, const one_order&, S&, S&) {});
  }

 protected:
  using products = detail::double_products<S>;
  struct one_order {
    typename products::factor factor;
    typename products::velocity w;
    S sine_first;  // s ∗ ω1, times C
    S p1, p2;
    [[no_unique_address]] std::conditional_t<keeps_products, double_kept_products<S>, nothing_kept> kept;
  };

  // add(k, order k, ṗ1, ṗ2): more torques, that depend on the velocities.
  template <class Add>
  PENDULA_INLINE void expand_with(const double_pendulum::over<S>& of, const vec<S, 4>& point, const vec<S, 4>& tail,
                                  const S* inverse, Add&& add) {
    const detail::double_inverse<S> mass = begin(of, point, tail);
    const int last = static_cast<int>(orders_.size()) - 1;
    for (int k = 0; k + 1 < last; ++k) advance(k, mass, inverse[k + 1], add);
    conclude(last - 1, mass, inverse[last], add);
  }

  // Order 0 of all but the velocities, and the inverse of the mass matrix.
  PENDULA_INLINE detail::double_inverse<S> begin(const double_pendulum::over<S>& of, const vec<S, 4>& point,
                                                 const vec<S, 4>& tail) {
    const auto pair = sincos(point[0], point[1]);
    const auto [s1, c1] = sincos_with_tail(pair[0], tail[0]);
    const auto [s2, c2] = sincos_with_tail(pair[1], tail[1]);
    const S sine = of.C * (s1 * c2 - c1 * s2), cosine = of.C * (c1 * c2 + s1 * s2);
    const S of_determinant = S(1.0) / (of.determinant_floor + sine * sine);
    const detail::double_inverse<S> mass{of.B * of_determinant, -(cosine * of_determinant), of.A * of_determinant};
    orders_[0].factor = products::factor_of(of.D * c1, of.D * s1, of.E * c2, of.E * s2, cosine, sine);
    orders_[0].p1 = point[2];
    orders_[0].p2 = point[3];
    return mass;
  }

  std::vector<one_order> orders_;

 public:
  // All of an order, for the series of variations.
  const one_order& order(int k) const { return orders_[static_cast<std::size_t>(k)]; }
  int last() const { return static_cast<int>(orders_.size()) - 1; }

  // Order k of ω_i, i = 0 or 1, below the order of the series.
  PENDULA_INLINE S velocity(int i, int k) const {
    return i == 0 ? products::first(orders_[k].w) : products::second(orders_[k].w);
  }

  // What is added to (θ1, θ2, p1, p2) in a time h: even and odd orders side by side.
  PENDULA_INLINE vec<S, 4> increment(S h, const S* inverse) const {
    const S square = h * h;
    typename products::velocity angles{}, angles_below{};
    S p1(0.0), p1_below(0.0), p2(0.0), p2_below(0.0);
    for (int k = static_cast<int>(orders_.size()) - 1; k >= 2; k -= 2) {
      angles = angles * square + orders_[k - 1].w * inverse[k];
      angles_below = angles_below * square + orders_[k - 2].w * inverse[k - 1];
      p1 = p1 * square + orders_[k].p1;
      p2 = p2 * square + orders_[k].p2;
      p1_below = p1_below * square + orders_[k - 1].p1;
      p2_below = p2_below * square + orders_[k - 1].p2;
    }
    angles = (angles * h + angles_below) * h;
    return {products::first(angles), products::second(angles), (p1 * h + p1_below) * h, (p2 * h + p2_below) * h};
  }

 private:
  // Order k of the velocities and k + 1 of the rest. Terms with the newest numbers come last: the others need not wait.
  template <class Add>
  PENDULA_INLINE void advance(int k, const detail::double_inverse<S>& mass, S inverse, Add& add) {
    one_order* const o = orders_.data();
    products sum;
    S turning(0.0);
    for (int j = 2; j < k; ++j) {
      sum.add(o[j].factor, o[k - j].w);
      turning = detail::with_product(turning, o[j].sine_first * products::second(o[k - j].w));
    }
    if (k > 1) {
      sum.add(o[1].factor, o[k - 1].w);
      turning = detail::with_product(turning, o[1].sine_first * products::second(o[k - 1].w));
    }
    if (k > 0) sum.add(o[k].factor, o[0].w);
    o[k].w = sum.solved(mass, o[k].p1, o[k].p2);
    sum.add(o[0].factor, o[k].w);
    keep(o[k], sum);
    o[k + 1].factor = sum.integrated(inverse);
    turn(k, turning, inverse, add);
  }

  // The last order: the factors need none.
  template <class Add>
  [[gnu::noinline]] void conclude(int k, const detail::double_inverse<S>& mass, S inverse, Add& add) {
    one_order* const o = orders_.data();
    products sum;
    S turning(0.0);
    const auto add_needed = [&sum](const typename products::factor& factor, const typename products::velocity& w) {
      if constexpr (keeps_products) {
        sum.add(factor, w);
      } else {
        sum.add_coupling(factor, w);
      }
    };
    for (int j = 1; j < k; ++j) {
      add_needed(o[j].factor, o[k - j].w);
      turning = detail::with_product(turning, o[j].sine_first * products::second(o[k - j].w));
    }
    add_needed(o[k].factor, o[0].w);
    o[k].w = sum.solved(mass, o[k].p1, o[k].p2);
    add_needed(o[0].factor, o[k].w);
    keep(o[k], sum);
    turn(k, turning, inverse, add);
  }

  PENDULA_INLINE static void keep(one_order& order, const products& sum) {
    order.sine_first = sum.sine_first();
    if constexpr (keeps_products) order.kept = {sum.sine_second(), sum.cosine_first()};
  }

  // Order k + 1 of the momenta.
  template <class Add>
  PENDULA_INLINE void turn(int k, S turning, S inverse, Add& add) {
    one_order* const o = orders_.data();
    if (k > 0) turning = detail::with_product(turning, o[0].sine_first * products::second(o[k].w));
    turning = detail::with_product(turning, o[k].sine_first * products::second(o[0].w));
    o[k + 1].p1 = (turning + o[k].factor.first_sine()) * -inverse;
    o[k + 1].p2 = (turning - o[k].factor.second_sine()) * inverse;
    add(k, o[k], o[k + 1].p1, o[k + 1].p2);
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
