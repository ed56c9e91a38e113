// A motion of the double pendulum together with variations of it, in lanes. The motion has the bits that it has alone;
// its variations are scaled, so that they can grow without end.
#pragma once

#include "pendula/drive/growth.hpp"
#include "pendula/kernels/variations.hpp"
#include "pendula/method/taylor.hpp"
#include "pendula/scalar/machine.hpp"
#include "pendula/system/double_pendulum_variations.hpp"

namespace pendula::inline PENDULA_MACHINE {

// What is told at an output, see `varied_by`.
template <int n, variation_use use>
inline constexpr std::size_t varied_output = 4 + 5 * n + (use == variation_use::megno ? 2 : 0);

template <class Number, int n, variation_use use>
class varied_stepper {
 public:
  using S = Number;
  using system = varied_double_pendulum<S>;
  using state = vec<S, varied_output<n, use>>;
  using variations = std::array<vec<S, 4>, n>;
  struct point {
    vec<S, 4 + 4 * n> head;  // the motion and its variations in canonical variables
    typename taylor_stepper<system>::point motion;
    megno_integrals<S> integrals;
  };

  // From variations of (θ1, θ2, ω1, ω2) at the time t0, the same of all motions.
  varied_stepper(const double_pendulum::over<S>& of, double log2_of_tolerance, double t0, const variations& start)
      : plain_(of, log2_of_tolerance), variations_series_(plain_.order()), t0_(t0), given_(start) {}

  void change(const double_pendulum::over<S>& of) { plain_.change(of); }
  void start(const S& t, const vec<S, 4>& y) {
    plain_.start(t, y);
    fifth_.fill(S(0.0));
    auto mine = given_;
    if constexpr (use == variation_use::orthogonal) make_orthogonal(mine);
    if constexpr (use == variation_use::megno) first_length_ = S(0.5) * logarithm(square_of_length(given_[0]));
    for (int i = 0; i < n; ++i) variations_[i] = of().canonical_variation(y, mine[i]);
    integrals_ = {};
    limit_ = S(often) * square_of_length(variations_[0]);
  }
  // What is told of the start, a state as it is given.
  state at_start(const vec<S, 4>& y) const {
    point here{{}, plain_.here(), integrals_};
    for (int i = 0; i < n; ++i) std::ranges::copy(variations_[i], here.head.begin() + 4 + 4 * i);
    state told = state_of(here);
    std::ranges::copy(y, told.begin());
    return told;
  }
  void take(int l, const varied_stepper<double, n, use>& from) {
    plain_.take(l, from.plain_);
    set_lanes(variations_, l, from.variations_);
    set_lanes(fifth_, l, from.fifth_);
    set_lanes(integrals_, l, from.integrals_);
    set_lane(limit_, l, from.limit_);
    set_lane(first_length_, l, from.first_length_);
  }

  PENDULA_INLINE void expand(const head_and_tail<S>& t, double direction) {
    plain_.expand(t, direction);
    variations_series_.expand(of(), plain_.series(), variations_, plain_.inverse());
    elapsed_ = (t.head - S(t0_)) + t.tail;
  }
  S length() const { return plain_.length(); }
  PENDULA_INLINE point after(S tau) const { return with_variations(plain_.after(tau), tau); }
  PENDULA_INLINE point at_end() const { return with_variations(plain_.at_end(), length()); }
  PENDULA_INLINE void proceed(const point& next) {
    plain_.proceed(next.motion);
    variations_ = variations_of(next);
    integrals_ = next.integrals;
    shorten();
  }

  state state_of(const point& there) const {
    state told;
    std::ranges::copy(plain_.state_of(there.motion), told.begin());
    variations mine = variations_of(there);
    for (auto& each : mine) each = of().variation_of(there.motion.head, each);
    vec<S, n> fifth = fifth_;
    if constexpr (use == variation_use::orthogonal) {
      const auto lengths = make_orthogonal(mine);
      for (int i = 0; i < n; ++i) fifth[i] = fifth[i] + logarithm(lengths[i]);
    }
    for (int i = 0; i < n; ++i) {
      std::ranges::copy(mine[i], told.begin() + 4 + 5 * i);
      told[8 + 5 * i] = fifth[i];
    }
    if constexpr (use == variation_use::megno) {
      told[4 + 5 * n] = there.integrals.of_growth;
      told[5 + 5 * n] = there.integrals.of_megno;
    }
    return told;
  }

  const system& of() const { return plain_.of(); }
  std::int64_t evaluations(int l = 0) const { return plain_.evaluations(l); }

 private:
  static constexpr double often = 0x1p20;  // the square of a growth that leaves ten digits of what is orthogonal

  PENDULA_INLINE point with_variations(const typename taylor_stepper<system>::point& motion, S tau) const {
    point there;
    there.motion = motion;
    std::ranges::copy(motion.head, there.head.begin());
    const S h = plain_.in_units(tau);
    for (int i = 0; i < n; ++i) {
      const auto added = variations_series_.increment(i, h);
      for (int j = 0; j < 4; ++j) there.head[4 + 4 * i + j] = variations_[i][j] + added[j];
    }
    if constexpr (use == variation_use::megno) {
      std::array<S, gauss_of_eight::count> growth;
      for (std::size_t node = 0; node < growth.size(); ++node) {
        const auto there_in_step = variations_series_.at(0, h * S(gauss_8.node[node]));
        growth[node] =
            S(0.5) * logarithm(square_of_length(there_in_step)) + (fifth_[0] * S(300.0 * ln_2) - first_length_);
      }
      there.integrals = integrals_.after(elapsed_, tau, growth);
    }
    return there;
  }
  PENDULA_INLINE static variations variations_of(const point& there) {
    variations mine;
    for (int i = 0; i < n; ++i) std::copy_n(there.head.begin() + 4 + 4 * i, 4, mine[i].begin());
    return mine;
  }

  // Long variations are made shorter. Each lane for itself: what it does must not depend on its neighbours.
  PENDULA_INLINE void shorten() {
    if constexpr (use == variation_use::orthogonal) {
      const auto grown = less(limit_, square_of_length(variations_[0]));
      if (any_lane(grown)) shorten_orthogonal(grown);
    } else {
      for (int i = 0; i < n; ++i) {
        const auto grown = less(S(taken_off * taken_off), square_of_length(variations_[i]));
        if (!any_lane(grown)) continue;
        const S factor = choose(grown, S(1.0 / taken_off), S(1.0));
        for (S& each : variations_[i]) each = each * factor;
        fifth_[i] = choose(grown, fifth_[i] + S(1.0), fifth_[i]);
      }
    }
  }
  template <class Mask>
  [[gnu::noinline]] void shorten_orthogonal(Mask grown) {
    const auto z = plain_.here().head;
    const auto y = of().from_canonical(z);
    variations mine;
    for (int i = 0; i < n; ++i) mine[i] = of().variation_of(z, variations_[i]);
    const auto lengths = make_orthogonal(mine);
    for (int i = 0; i < n; ++i) {
      fifth_[i] = choose(grown, fifth_[i] + logarithm(lengths[i]), fifth_[i]);
      const auto shorter = of().canonical_variation(y, mine[i]);
      for (int j = 0; j < 4; ++j) variations_[i][j] = choose(grown, shorter[j], variations_[i][j]);
    }
    limit_ = choose(grown, S(often) * square_of_length(variations_[0]), limit_);
  }

  // Gram and Schmidt's; the lengths that were taken off.
  static vec<S, n> make_orthogonal(variations& all) {
    vec<S, n> lengths;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        S along(0.0);
        for (int k = 0; k < 4; ++k) along = along + all[i][k] * all[j][k];
        for (int k = 0; k < 4; ++k) all[i][k] = all[i][k] - along * all[j][k];
      }
      lengths[i] = square_root(square_of_length(all[i]));
      for (int k = 0; k < 4; ++k) all[i][k] = all[i][k] / lengths[i];
    }
    return lengths;
  }

  template <class, int, variation_use>
  friend class varied_stepper;

  taylor_stepper<system> plain_;
  double_pendulum_variations<S, n> variations_series_;
  double t0_;
  variations given_, variations_;
  vec<S, n> fifth_;
  megno_integrals<S> integrals_;
  S limit_, first_length_{0.0}, elapsed_;
};

}  // namespace pendula::inline PENDULA_MACHINE
