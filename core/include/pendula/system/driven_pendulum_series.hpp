// Taylor series of the driven pendulum (Jorba & Zou 2005, Exp. Math. 14, 99): that of the simple one,
//     ω' = −(m g c / I) s + drive + pivot ∗ (cos α c + sin α s) − b ω − r ω³ − σ (τc + d ω²),
// with σ = ±1 for the piece of the motion. What has a coefficient of zero is left out.
#pragma once

#include "pendula/system/driven_pendulum.hpp"
#include "pendula/system/increment_by_fourths.hpp"
#include "pendula/system/two_orders.hpp"

namespace pendula::inline PENDULA_MACHINE {

// What belongs to the orders of one system's series, whatever the state: of a trajectory of doubles it is kept from
// step to step.
template <class S>
class driven_pendulum_factors {
 public:
  using pair = sine_with_cosine<S>;
  // Of orders k + 1 and k + 2, for an even k: 1/(k + 1) for sine and cosine turned by a quarter and b/(k + 1); what
  // stands before the sine or cosine of the drive's phase; 1/(k + 1).
  struct of_two {
    typename two_orders<S>::turns turns;
    std::array<S, 2> drive, friction, inverse;
  };

  explicit driven_pendulum_factors(std::size_t orders) : of_two_(orders / 2) {}

  PENDULA_INLINE void prepare(const driven_pendulum::over<S>& of, const S* inverse) {
    const S frequency = present(of.drive.amplitude) ? of.drive.frequency : S(0.0);
    if constexpr (std::same_as<S, double>) {
      const std::array key{frequency, of.viscous, inverse[1]};
      if (key == key_) return;
      key_ = key;
    }
    work_out(frequency, of.viscous, inverse);
  }
  PENDULA_INLINE const of_two* data() const { return of_two_.data(); }

 private:
  [[gnu::noinline]] void work_out(const S& frequency, const S& viscous, const S* inverse) {
    S power(1.0);  // Ω^k/k!, with the signs of the derivatives cos, −sin, −cos, sin
    for (std::size_t k = 0; k < 2 * of_two_.size(); ++k) {
      if (k > 0) power = power * (frequency * inverse[k]);
      if (k % 2 == 1) power = -power;
      of_two& of = of_two_[k / 2];
      of.drive[k % 2] = power * inverse[k + 1];
      of.friction[k % 2] = viscous * inverse[k + 1];
      of.inverse[k % 2] = inverse[k + 1];
      if (k % 2 == 1) of.turns = two_orders<S>::turns_of(pair::factor(inverse[k]), pair::factor(inverse[k + 1]));
    }
  }

  std::array<double, 3> key_{__builtin_nan(""), 0.0, 0.0};
  std::vector<of_two> of_two_;
};

template <class S>
class driven_pendulum_series : public one_bob_series<S> {
 public:
  explicit driven_pendulum_series(int order)
      : one_bob_series<S>(order),
        factors_(this->velocity_.size()),
        orders_(this->velocity_.size()),
        square_(this->velocity_.size()),
        pivot_(this->velocity_.size()) {}

  // It is not inlined, and what is rare in it neither: what each step runs through has to fit in the processor's cache
  // of decoded instructions.
  [[gnu::noinline]] void expand(const driven_pendulum::over<S>& of, const head_and_tail<S>& t, const vec<S, 2>& point,
                                const vec<S, 2>& tail, const S* inverse) {
    if (!present(of.senses[0])) return this->velocity_.assign(this->velocity_.size(), S(0.0));
    factors_.prepare(of, inverse);
    terms now{of};
    sine_cosine<S> angle;
    if (present(of.drive.amplitude)) {
      const auto [head, rest] = phase_at(of.drive.frequency, of.drive.phase, t);
      const auto [of_angle, of_phase] = sincos(point[0], head);
      const auto phase = sincos_with_tail(of_phase, rest);
      now.sine = of.drive.amplitude * phase.sin;
      now.cosine = of.drive.amplitude * phase.cos;
      angle = of_angle;
    } else {
      angle = sincos(point[0]);
    }
    const auto [s, c] = sincos_with_tail(angle, tail[0]);
    if constexpr (products_written_out > 0) {
      if (!now.longer()) return orders<false>(now, t, point[1], s, c);
    }
    longer_orders(now, t, point[1], s, c);
  }

  // What is added to (θ, ω) in a time h, which the next step waits for.
  PENDULA_INLINE vec<S, 2> increment(S h, const S* inverse) const {
    return increment_by_fourths(this->order_, this->velocity_.data(), inverse, h);
  }

 private:
  using pair = sine_with_cosine<S>;
  using two = two_orders<S>;
  using factors = driven_pendulum_factors<S>;
  // Of one trajectory of doubles the sums of products are written out, up to the order of the finest tolerance: they
  // then need no counting. Not in a page, which would be longer to load.
#if defined(__wasm__)
  static constexpr std::size_t products_written_out = 0;
#else
  static constexpr std::size_t products_written_out = std::same_as<S, double> ? 13 : 0;
#endif

  // The equation, and the drive's sine and cosine.
  struct terms {
    const driven_pendulum::over<S>& of;
    S sine{0.0}, cosine{0.0};
    harmonic_series<S> pivot{};

    bool moved = present(of.pivot.amplitude), dragged = present(of.quadratic) || present(of.cubic);

    bool longer() const { return moved || dragged; }
  };

  // The orders that the next ones are worked out from, but for older products: the first three, and the newest. They
  // stand in registers, where what is read from memory again would be waited for.
  struct at_hand {
    S w0, before, newest;
    pair turned_first, pair_before, newest_pair;
    two turned_two, two_after;  // of orders 0 and 1, 1 and 2
    typename two::velocities velocities, velocities_after;
  };

  // What is kept of an order, with the one after it where products of two orders at once need that.
  struct kept {
    two neighbours;
    typename two::velocities velocities;
    pair both;
  };
  // Where the two next orders are worked out: their factors, and what is kept of the newest order k and of order k/2.
  struct place {
    const typename factors::of_two* of_two;
    const kept* middle;
    const S* middle_velocity;
    kept* newest;
    S* velocity;
  };

  [[gnu::noinline]] void longer_orders(terms& now, const head_and_tail<S>& t, const S& w0, const S& s, const S& c) {
    orders<true>(now, t, w0, s, c);
  }
  template <bool longer>
  PENDULA_INLINE void orders(terms& now, const head_and_tail<S>& t, const S& w0, const S& s, const S& c) {
    const bool moved = longer && now.moved;
    if (moved) now.pivot.start(now.of.pivot, t);
    // without a moving pivot sine and cosine are carried times the frequency's square, and the pull is the sine
    const S& square = now.of.frequency_squared;
    S* const w = this->velocity_.data();
    place at{factors_.data(), orders_.data(), w, orders_.data(), w};
    at_hand h = first_orders<longer>(now, at, w0, moved ? pair::of(s, c) : pair::of(square * s, square * c));
    const auto pairs = static_cast<std::size_t>(this->order_) / 2, last_middle = pairs - 1;
    for (std::size_t middle = 1; middle < pairs; ++middle) {
      ++at.of_two;
      ++at.middle;
      ++at.middle_velocity;
      at.newest += 2;
      at.velocity += 2;
      two_more<longer>(now, h, at, middle, 2 * middle < last_middle);
    }
  }

  template <bool longer>
  PENDULA_INLINE at_hand first_orders(terms& now, const place& at, const S& w0, const pair& x0) {
    const auto &first = at.of_two->turns.low(), &second = at.of_two->turns.high();
    const pair turned_first = x0.exchanged();
    keep(at, 0, w0, x0);
    const S w1 = next_velocity<longer>(now, at, 0, 0, x0, w0);
    const pair x1 = turned_first.times(first * w0);
    keep(at, 1, w1, x1);
    const S w2 = next_velocity<longer>(now, at, 0, 1, x1, w1);
    const pair x2 = turned_first.times(second) * w1 + x1.turned(second * w0);
    keep(at, 2, w2, x2);
    keep_two(at, w0, x0, w1, x1, w2, x2);
    return {w0,
            w1,
            w2,
            turned_first,
            x1,
            x2,
            two::of(x0, x1).exchanged(),
            two::of(x1, x2),
            two::of(w0, w1),
            two::of(w1, w2)};
  }

  PENDULA_INLINE static void keep(const place& at, std::size_t next, const S& w, const pair& x) {
    at.velocity[next] = w;
    at.newest[next].both = x;
  }
  // Of orders k, k + 1 and k + 2, what products of two orders at once need.
  PENDULA_INLINE static void keep_two(const place& at, const S& w, const pair& x, const S& w1, const pair& x1,
                                      const S& w2, const pair& x2) {
    at.newest[0].neighbours = two::of(x, x1);
    at.newest[0].velocities = two::of(w, w1);
    at.newest[1].neighbours = two::of(x1, x2);
    at.newest[1].velocities = two::of(w1, w2);
  }

  // Orders k + 1 and k + 2, for an even k > 0. Each order waits for the one before: its sum ends with the newest
  // numbers, which are multiplied by what has been worked out before they come. `needed_again`: by products of two
  // orders at once.
  template <bool longer>
  PENDULA_INLINE void two_more(terms& now, at_hand& h, const place& at, std::size_t middle, bool needed_again) {
    const auto f = at.of_two->turns;
    const auto second = f.high();
    const S w1 = next_velocity<longer>(now, at, 2 * middle, 0, h.newest_pair, h.newest);
    two older = older_products(at, middle);
    if (middle > 1) older = older + (h.two_after * h.before + two::twice(h.pair_before) * h.velocities_after);
    const two sum = (older.exchanged() * f + (h.turned_two * f) * h.newest) +
                    two::twice(h.newest_pair.exchanged()) * (f * h.velocities);
    const pair x1 = sum.low();
    const pair x2 = (sum.high() + h.turned_first.times(second) * w1) + x1.turned(second * h.w0);
    keep(at, 1, w1, x1);
    const S w2 = next_velocity<longer>(now, at, 2 * middle, 1, x1, w1);
    keep(at, 2, w2, x2);
    if (needed_again) keep_two(at, h.newest, h.newest_pair, w1, x1, w2, x2);
    h.before = w1;
    h.newest = w2;
    h.pair_before = x1;
    h.newest_pair = x2;
  }

  // Of orders k and k + 1 of the product, the sums but for the newest numbers, from the middle outward: those of the
  // older numbers are there when the newer ones come. Half of them are two orders of sine and cosine times one of the
  // velocity, half one times two: the newest are then read as they were stored, one by one. That of the middle has no
  // other.
  PENDULA_INLINE static two older_products(const place& at, std::size_t middle) {
    const S* const w = at.middle_velocity;
    const kept* const x = at.middle;
    two below = two::of(x[0].both * w[0], pair::of(S(0.0), S(0.0)));
    if (middle <= 2) return below;
    below = below + x[-1].neighbours * w[1];
    two above = two::twice(x[1].both) * x[-1].velocities;
    const auto outward = [&](std::ptrdiff_t i) __attribute__((always_inline)) {
      below = below + x[-i].neighbours * w[i];
      above = above + two::twice(x[i].both) * x[-i].velocities;
      return true;
    };
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
      (void)((i + 3 < middle && outward(i + 2)) && ...);
    }(std::make_index_sequence<products_written_out>{});
    for (std::size_t i = products_written_out + 2; i + 1 < middle; ++i) outward(i);
    return below + above;
  }

  // Order k + 1 + next, of orders k + next.
  template <bool longer>
  PENDULA_INLINE S next_velocity(terms& now, const place& at, std::size_t k, std::size_t next, const pair& x,
                                 const S& w) {
    const auto& of = now.of;
    const auto& by = *at.of_two;
    const S pull = longer && now.moved ? of.frequency_squared * x.first() : x.first();
    const S drive = by.drive[next] * (next == 0 ? now.cosine : now.sine);
    S rate = (drive - by.friction[next] * w) - pull * by.inverse[next];
    if (k + next == 0 && present(of.coulomb)) rate = rate - of.senses[0] * of.coulomb * by.inverse[0];
    if constexpr (longer)
      if (now.longer()) rate = rate + longer_terms(now, at, k + next) * by.inverse[next];
    return rate;
  }

  // Order k of what the pivot's motion adds, and of drag.
  [[gnu::noinline]] S longer_terms(terms& now, const place& at, std::size_t k) {
    S sum(0.0);
    if (now.moved) {
      sum = moved_by(now.of, k, now.pivot.order());
      const auto& turns = at.of_two->turns;
      now.pivot.advance(k % 2 == 0 ? turns.low() : turns.high());
    }
    return now.dragged ? sum - dragged(now.of, k, present(now.of.cubic)) : sum;
  }

  // Order k of what the pivot's motion adds.
  S moved_by(const driven_pendulum::over<S>& of, int k, const S& order) {
    pivot_[k] = order;
    pair sum = pair::of(S(0.0), S(0.0));
    for (int j = 0; j <= k; ++j) sum = sum + orders_[k - j].both * pivot_[j];
    return of.across * sum.second() + of.along * sum.first();
  }

  // Order k of σ d ω² + r ω³.
  S dragged(const driven_pendulum::over<S>& of, int k, bool cubic) {
    const S* const w = this->velocity_.data();
    S of_square(0.0), of_cube(0.0);
    for (int j = 0; j <= k; ++j) of_square = of_square + w[j] * w[k - j];
    square_[k] = of_square;
    if (cubic)
      for (int j = 0; j <= k; ++j) of_cube = of_cube + square_[j] * w[k - j];
    return of.senses[0] * of.quadratic * of_square + of.cubic * of_cube;
  }

  factors factors_;
  std::vector<kept> orders_;
  std::vector<S> square_, pivot_;
};

}  // namespace pendula::inline PENDULA_MACHINE
