// Taylor series of the driven pendulum (Jorba & Zou 2005, Exp. Math. 14, 99): that of the simple one,
//     ω' = −(m g c / I) s + drive + pivot ∗ (cos α c + sin α s) − b ω − r ω³ − σ (τc + d ω²),
// with σ = ±1 for the piece of the motion. What has a coefficient of zero is left out.
#pragma once

#include "pendula/system/driven_pendulum.hpp"
#include "pendula/system/increment_by_fourths.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// Products of sine and cosine with the velocity, two orders at a time, and what they are made of as it is stored.
template <class S>
struct two_orders {
  using pair = sine_with_cosine<S>;
  using turned = pair;
  struct velocities {
    S first, second;
  };
  pair first, second;

  PENDULA_INLINE static turned stored(const pair& x) { return x; }
  PENDULA_INLINE static velocities stored(const S& first, const S& second) { return {first, second}; }
  PENDULA_INLINE static two_orders product(const turned& x, const velocities& w) { return {x * w.first, x * w.second}; }
  PENDULA_INLINE friend two_orders operator+(const two_orders& a, const two_orders& b) {
    return {a.first + b.first, a.second + b.second};
  }
};
// For one trajectory of doubles in four lanes: the same operations on the same numbers. Each number is stored as often
// as it is loaded: a load that spans two stores would wait for them.
template <>
struct two_orders<double> {
  using pair = sine_with_cosine<double>;
  using turned = pack<double, 4>;
  using velocities = pack<double, 4>;
  pair first, second;

  PENDULA_INLINE static turned stored(const pair& x) { return joined(x.both, x.both); }
  PENDULA_INLINE static velocities stored(double first, double second) {
    return joined(pack<double, 2>(first), pack<double, 2>(second));
  }
  PENDULA_INLINE static pack<double, 4> product(turned x, velocities w) { return x * w; }
  PENDULA_INLINE two_orders(pack<double, 4> both) : first{halves(both)[0]}, second{halves(both)[1]} {}
  two_orders(pair a, pair b) : first(a), second(b) {}
};

}  // namespace detail

// What belongs to the orders of one system's series, whatever the state: of a trajectory of doubles it is kept from
// step to step.
template <class S>
class driven_pendulum_factors {
 public:
  using turn = typename sine_with_cosine<S>::turn;

  explicit driven_pendulum_factors(std::size_t orders) : drive_(orders), friction_(orders), turn_(orders) {}

  PENDULA_INLINE void prepare(const driven_pendulum::over<S>& of, const S* inverse) {
    const S frequency = present(of.drive.amplitude) ? of.drive.frequency : S(0.0);
    if constexpr (std::same_as<S, double>) {
      const std::array key{frequency, of.viscous, inverse[1]};
      if (key == key_) return;
      key_ = key;
    }
    work_out(frequency, of.viscous, inverse);
  }

  // Of orders k of the drive, times the factor of the order that it goes into: that of (sine, cosine) of its phase.
  PENDULA_INLINE const S& drive(int k) const { return drive_[k]; }
  // b/k, and 1/k for sine and cosine turned by a quarter.
  PENDULA_INLINE const S& friction(int k) const { return friction_[k]; }
  PENDULA_INLINE const turn& turned(int k) const { return turn_[k]; }

 private:
  [[gnu::noinline]] void work_out(const S& frequency, const S& viscous, const S* inverse) {
    S power(1.0);  // Ω^k/k!, with the signs of the derivatives cos, −sin, −cos, sin
    for (std::size_t k = 0; k + 1 < turn_.size(); ++k) {
      if (k > 0) power = power * (frequency * inverse[k]);
      if (k % 2 == 1) power = -power;
      drive_[k] = power * inverse[k + 1];
      friction_[k + 1] = viscous * inverse[k + 1];
      turn_[k + 1] = sine_with_cosine<S>::factor(inverse[k + 1]);
    }
  }

  std::array<double, 3> key_{__builtin_nan(""), 0.0, 0.0};
  std::vector<S> drive_, friction_;
  std::vector<turn> turn_;
};

template <class S>
class driven_pendulum_series : public one_bob_series<S> {
 public:
  explicit driven_pendulum_series(int order)
      : one_bob_series<S>(order),
        factors_(this->velocity_.size()),
        turned_(this->velocity_.size()),
        stored_(this->velocity_.size()),
        velocities_(this->velocity_.size()),
        square_(this->velocity_.size()),
        pivot_(this->velocity_.size()) {}

  PENDULA_INLINE void expand(const driven_pendulum::over<S>& of, const head_and_tail<S>& t, const vec<S, 2>& point,
                             const vec<S, 2>& tail, const S* inverse) {
    if (!present(of.senses[0])) return this->velocity_.assign(this->velocity_.size(), S(0.0));
    factors_.prepare(of, inverse);
    const bool moved = present(of.pivot.amplitude);
    terms now{of, moved, present(of.quadratic), present(of.cubic), inverse};
    if (present(of.drive.amplitude)) {
      const auto phase = of.drive.turned(t);
      now.sine = of.drive.amplitude * phase.sin;
      now.cosine = of.drive.amplitude * phase.cos;
    }
    if (moved) now.pivot.start(of.pivot, t);
    const auto [s, c] = sincos_with_tail(sincos(point[0]), tail[0]);
    // without a moving pivot sine and cosine are carried times the frequency's square, and the pull is the sine
    at_hand h = first_orders(now, point[1],
                             moved ? pair::of(s, c) : pair::of(of.frequency_squared * s, of.frequency_squared * c));
    int done = 2;
    if constexpr (unrolled > 0) {
      if (!now.longer()) {
        written_out(now, h, std::make_integer_sequence<int, unrolled>{});
        done += 2 * unrolled;
      }
    }
    for (int k = done; k < this->order_; k += 2) two_more<true>(now, h, k);
  }

  // What is added to (θ, ω) in a time h, which the next step waits for.
  PENDULA_INLINE vec<S, 2> increment(S h, const S* inverse) const {
    return increment_by_fourths(this->order_, this->velocity_.data(), inverse, h);
  }

 private:
  using pair = sine_with_cosine<S>;
  using two = detail::two_orders<S>;
  // Of one trajectory of doubles the loop over the orders is written out, up to the order of the finest tolerance: with
  // its places known, what an order needs of those before it stays in registers. Not in a page, which would be a
  // twentieth longer to load.
#if defined(__wasm__)
  static constexpr int unrolled = 0;
#else
  static constexpr int unrolled = std::same_as<S, double> ? 15 : 0;
#endif

  // The equation, which of its longer terms it has, and the drive's sine and cosine.
  struct terms {
    const driven_pendulum::over<S>& of;
    bool moved, quadratic, cubic;
    const S* inverse;
    S sine{0.0}, cosine{0.0};
    harmonic_series<S> pivot{};

    bool longer() const { return moved || quadratic || cubic; }
  };

  // The orders that the next ones are worked out from, but for older products: the first three, and the newest. They
  // stand in registers, where what is read from memory again would be waited for.
  struct at_hand {
    S w0, w1, w2, two_before, before, newest;  // of the velocity
    pair x0, x1, x2, pair_before, newest_pair;
  };

  PENDULA_INLINE void keep(int k, const S& before, const S& w, const pair& x) {
    this->velocity_[k] = w;
    turned_[k] = x;
    stored_[k] = two::stored(x);
    velocities_[k - 1] = two::stored(before, w);
  }

  // All further orders, for one trajectory of doubles.
  template <int... i>
  [[gnu::noinline]] void written_out(terms& now, at_hand h, std::integer_sequence<int, i...>) {
    (void)((2 * i + 2 < this->order_ && (two_more<false>(now, h, std::integral_constant<int, 2 * i + 2>{}), true)) &&
           ...);
  }

  PENDULA_INLINE at_hand first_orders(terms& now, const S& w0, const pair& x0) {
    const auto &first = factors_.turned(1), &second = factors_.turned(2);
    this->velocity_[0] = w0;
    turned_[0] = x0;
    stored_[0] = two::stored(x0);
    const S w1 = next_velocity<true>(now, 0, x0, w0);
    const pair x1 = x0.turned(first * w0);
    keep(1, w0, w1, x1);
    const S w2 = next_velocity<true>(now, 1, x1, w1);
    const pair x2 = x0.turned(second) * w1 + x1.turned(second * w0);
    keep(2, w1, w2, x2);
    return {w0, w1, w2, w0, w1, w2, x0, x1, x2, x1, x2};
  }

  // Orders k + 1 and k + 2, for an even k > 0. Each order waits for the one before: its sum ends with the newest
  // numbers, which are multiplied by what has been worked out before they come.
  template <bool longer, class Place>
  PENDULA_INLINE void two_more(terms& now, at_hand& h, Place k) {
    const auto &first = factors_.turned(k + 1), &second = factors_.turned(k + 2);
    const S w1 = next_velocity<longer>(now, k, h.newest_pair, h.newest);
    const two older = k > 2 ? older_products(h, k) : two{pair::of(S(0.0), S(0.0)), h.x1 * h.w2};
    const pair x1 = ((older.first + h.pair_before * h.w1).turned(first) + h.x0.turned(first) * h.newest) +
                    h.newest_pair.turned(first * h.w0);
    const pair x2 =
        (older.second + h.newest_pair * h.w1).turned(second) + (h.x0.turned(second) * w1 + x1.turned(second * h.w0));
    keep(k + 1, h.newest, w1, x1);
    const S w2 = next_velocity<longer>(now, k + 1, x1, w1);
    keep(k + 2, w1, w2, x2);
    h.two_before = h.newest;
    h.before = w1;
    h.newest = w2;
    h.pair_before = x1;
    h.newest_pair = x2;
  }

  // Of orders k and k + 1 of the product, the sums but for the newest numbers, from the middle outward: those of the
  // older numbers are there when the newer ones come.
  template <class Place>
  PENDULA_INLINE two older_products(const at_hand& h, Place k) const {
    const two edges{h.x2 * h.two_before + h.x1 * h.before, (h.x2 * h.before + h.pair_before * h.w2) + h.x1 * h.newest};
    if (k == 4) return edges;
    const int middle = k / 2;
    auto below = two::product(stored_[middle], velocities_[k - middle]);
    auto above = two::product(stored_[middle + 1], velocities_[k - middle - 1]);
    const auto outward = [&](int i) __attribute__((always_inline)) {
      below = below + two::product(stored_[middle - i], velocities_[k - middle + i]);
      above = above + two::product(stored_[middle + 1 + i], velocities_[k - middle - 1 - i]);
    };
    if constexpr (std::is_integral_v<Place>) {
      for (int i = 1; i <= middle - 3; ++i) outward(i);
    } else {
#pragma GCC unroll 16
      for (int i = 1; i <= middle - 3; ++i) outward(i);
    }
    const two sum = above + below;
    return {sum.first + edges.first, sum.second + edges.second};
  }

  template <bool longer>
  PENDULA_INLINE S next_velocity(terms& now, int k, const pair& x, const S& w) {
    const auto& of = now.of;
    const S pull = longer && now.moved ? of.frequency_squared * x.first() : x.first();
    const S drive = factors_.drive(k) * (k % 2 == 0 ? now.cosine : now.sine);
    S rate = (drive - factors_.friction(k + 1) * w) - pull * now.inverse[k + 1];
    if (k == 0 && present(of.coulomb)) rate = rate - of.senses[0] * of.coulomb * now.inverse[1];
    if constexpr (longer)
      if (now.longer()) rate = rate + longer_terms(now, k) * now.inverse[k + 1];
    return rate;
  }

  // Order k of what the pivot's motion adds, and of drag.
  [[gnu::noinline]] S longer_terms(terms& now, int k) {
    S sum(0.0);
    if (now.moved) {
      sum = moved_by(now.of, k, now.pivot.order());
      now.pivot.advance(factors_.turned(k + 1));
    }
    return now.quadratic || now.cubic ? sum - dragged(now.of, k, now.cubic) : sum;
  }

  // Order k of what the pivot's motion adds.
  S moved_by(const driven_pendulum::over<S>& of, int k, const S& order) {
    pivot_[k] = order;
    pair sum = pair::of(S(0.0), S(0.0));
    for (int j = 0; j <= k; ++j) sum = sum + turned_[k - j] * pivot_[j];
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

  driven_pendulum_factors<S> factors_;
  std::vector<pair> turned_;
  std::vector<typename two::turned> stored_;
  std::vector<typename two::velocities> velocities_;  // of order k and the one after it
  std::vector<S> square_, pivot_;
};

}  // namespace pendula::inline PENDULA_MACHINE
