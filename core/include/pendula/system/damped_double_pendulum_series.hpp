// Taylor series of the double pendulum with friction in its joints. Where both slip it is that of the ideal one with
// their torques; where one is held, it is that of a single angle, from which the momenta follow:
//     joint 1 held: B ω2' = −E s2 + f2,   joint 2 held: (A + B + 2 C cos δ) ω' = −D s1 − E s2 + f1, with δ constant,
//     p1 = A ω1 + C c ∗ ω2,   p2 = C c ∗ ω1 + B ω2.
#pragma once

#include "pendula/system/damped_double_pendulum.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <class S>
class damped_double_pendulum_series : public double_pendulum_series<S> {
 public:
  using double_pendulum_series<S>::double_pendulum_series;
  using damped = damped_double_pendulum::over<S>;

  PENDULA_INLINE void expand(const damped& of, const head_and_tail<S>&, const vec<S, 4>& point, const vec<S, 4>& tail,
                             const S* inverse) {
    if (!present(of.senses[0]) || !present(of.senses[1])) return expand_held(of, point, tail, inverse);
    this->expand_with(of.ideal, point, tail, inverse, [&](int k, const one_order& at, S& p1, S& p2) {
      const auto [f1, f2] = friction(of, k, products::first(at.w), products::second(at.w));
      p1 = p1 + (f1 - f2) * inverse[k + 1];
      p2 = p2 + f2 * inverse[k + 1];
    });
  }

 private:
  using typename double_pendulum_series<S>::products;
  using typename double_pendulum_series<S>::one_order;

  // Order k of the torques in the joints.
  PENDULA_INLINE static vec<S, 2> friction(const damped& of, int k, const S& first, const S& second) {
    const S f1 = of.viscous[0] * first, f2 = of.viscous[1] * (second - first);
    if (k > 0) return {-f1, -f2};
    return {-(f1 + of.senses[0] * of.coulomb[0]), -(f2 + of.senses[1] * of.coulomb[1])};
  }

  [[gnu::noinline]] void expand_held(const damped& of, const vec<S, 4>& point, const vec<S, 4>& tail,
                                     const S* inverse) {
    this->begin(of.ideal, point, tail);
    one_order* const o = this->orders_.data();
    const bool first_slips = present(of.senses[0]), second_slips = present(of.senses[1]);
    const S zero(0.0), cosine = of.ideal.canonical({point[0], point[1], zero, S(1.0)})[2];
    const S inertia = first_slips ? (of.ideal.A + cosine) + (of.ideal.B + cosine) : of.ideal.B;
    S w = first_slips ? (point[2] + point[3]) / inertia : second_slips ? point[3] / inertia : zero;
    const int last = static_cast<int>(this->orders_.size()) - 1;
    for (int k = 0; k <= last; ++k) {
      o[k].w = products::velocity_of(first_slips ? w : zero, w);
      products sum;
      for (int j = 0; j <= k; ++j) sum.add(o[j].factor, o[k - j].w);
      if (k > 0) {
        o[k].p1 = of.ideal.A * products::first(o[k].w) + sum.cosine_second();
        o[k].p2 = of.ideal.B * products::second(o[k].w) + sum.cosine_first();
      }
      if (k == last || !(first_slips || second_slips)) continue;
      o[k + 1].factor = sum.integrated(inverse[k + 1]);
      const auto [f1, f2] = friction(of, k, products::first(o[k].w), products::second(o[k].w));
      const S torque =
          first_slips ? f1 - (o[k].factor.first_sine() + o[k].factor.second_sine()) : f2 - o[k].factor.second_sine();
      w = torque / inertia * inverse[k + 1];
    }
  }
};

}  // namespace pendula::inline PENDULA_MACHINE
