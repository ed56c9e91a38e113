// The Taylor method: the series of the motion is worked out to a high order, its last terms say how far it reaches, and
// its sum there begins the next step (Jorba & Zou 2005, Exp. Math. 14, 99; Biscani & Izzo 2021, MNRAS 504, 2614).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pendula/description.hpp"
#include "pendula/method/amplitude.hpp"
#include "pendula/method/joints.hpp"
#include "pendula/scalar/compensated.hpp"
#include "pendula/scalar/polynomial_roots.hpp"
#include "pendula/scalar/rough_powers.hpp"
#include "pendula/system/series.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Order 1 − ½ ln(tolerance) makes the least work for the distance (Jorba & Zou 2005, eq. 9); the next even number.
inline int taylor_order(double log2_of_tolerance) {
  const double pairs = 0.5 * (1.0 - 0.34657359027997264 * log2_of_tolerance);  // ½ ln 2
  return 2 * static_cast<int>(std::ceil(pairs - 1e-3));
}

// Where an order is a few products, a run of one trajectory waits for the one before longer than it works: a system can
// ask for more of them, which make longer steps.
template <class Sys>
constexpr int more_orders() {
  if constexpr (requires { Sys::more_orders; }) {
    return Sys::more_orders;
  } else {
    return 0;
  }
}

template <Analytic Sys>
class taylor_stepper {
 public:
  using S = typename Sys::scalar;
  using state = typename Sys::state;
  using point = compensated_point<state>;
  using R = roughly<S>;
  static constexpr bool waits_for_length = more_orders<Sys>() > 0 && has_double_precision<S>;
  static constexpr double precision_inside = 0x1p-50;  // of the motion inside a step, in parts of its change

  [[gnu::noinline]] taylor_stepper(const Sys& system, double log2_of_tolerance)
      : order_(taylor_order(log2_of_tolerance) + more_orders<Sys>()),
        series_(order_),
        inverse_(static_cast<std::size_t>(order_) + 2),
        log2_of_reach_((log2_of_tolerance - 5.0) / (order_ + 1)) {
    for (int i = 0; i < 4; ++i) per_order_.set(i, 1.0 / (order_ - 3 + i));
    double log2_of_factorial = 0.0;
    for (int k = 1; k <= order_ + 1; ++k) log2_of_factorial += rough_log2(static_cast<double>(k));
    longest_phase_ = 1.1 * rough_exp2((log2_of_tolerance - 5.0 + log2_of_factorial) / (order_ + 1));
    change(system);
  }

  // Takes another system.
  void change(const Sys& system) {
    system_ = system;
    const R frequency_squared = rough(system.largest_frequency_squared());
    // seconds, but where their powers would leave the range of numbers
    const R log2_of_frequency = nearest_whole(R(0.5) * rough_log2(frequency_squared));
    const auto extreme = less(R(20.0), magnitude(log2_of_frequency));
    unit_ = choose(extreme, power_of_two(-log2_of_frequency), R(1.0));
    in_units_ = R(1.0) / unit_;
    for (int k = 1; k <= order_ + 1; ++k) inverse_[k] = S(unit_) / S(static_cast<double>(k));
    longest_ = R(longest_phase_) / (square_root(frequency_squared) * unit_);
  }

  // Places the motion at a state (θ…, ω…). Errors are in parts of a radian, or of the amplitude of a small swing.
  void start(const S& t, const state& y) {
    at_.head = system_.canonical(y);
    at_.tail.fill(S(0.0));
    log2_of_scale_ = log2_of_amplitude(system_, y);
    joints_.start(system_, t, y);
  }

  // Where the motion is, and all that the next steps depend on.
  struct memory {
    point at;
    [[no_unique_address]] joints_of<Sys> joints;
  };
  memory remembered() const { return {at_, joints_}; }
  const point& here() const { return at_; }
  void resume(const memory& from) {
    at_ = from.at;
    joints_ = from.joints;
    joints_.tell(system_);
  }
  void proceed(const point& next) {
    at_ = next;
    joints_.move_on();
  }

  // Of a system in pieces: goes on from a point with other joints.
  const joints_of<Sys>& joints() const { return joints_; }
  void begin_piece(const S&, const point& from, const joints_of<Sys>& joints) { resume({from, joints}); }

  template <class Function>
  void each_number(Function&& change) {
    for (S& x : at_.head) change(x);
    for (S& x : at_.tail) change(x);
  }

  // Works out the series at the point at time t, and how far it reaches, forward in time or (direction −1) backward: as
  // far as the first term left out stays below the error allowed. Four orders tell the radius of convergence, and the
  // least counts: a motion from rest has none of the odd ones, one from rest at a right angle every fourth only.
  PENDULA_INLINE void expand(const head_and_tail<S>& t, double direction) {
    series_.expand(system_, t, at_.head, at_.tail, inverse_.data());
    R reach;
    if constexpr (waits_for_length) {
      reach = coarse_exp2(coarse_log2_of_radius() + R(log2_of_reach_));
    } else {
      R radius = log2_of_radius(order_);
      for (int k = order_ - 1; k > order_ - 4; --k) {
        const R other = log2_of_radius(k);
        radius = choose(less(other, radius), other, radius);
      }
      reach = rough_exp2(radius + R(log2_of_reach_));
    }
    length_ = R(direction) * choose(less(longest_, reach), longest_, reach);
    ++expansions_;
  }
  R length() const { return length_ * unit_; }
  // For the series of the motion's variations.
  const typename Sys::series& series() const { return series_; }
  const S* inverse() const { return inverse_.data(); }
  int order() const { return order_; }
  S in_units(S tau) const { return tau * S(in_units_); }

  PENDULA_INLINE point after(S tau) const { return after_units(tau * S(in_units_)); }
  // The end of the step, which is after(length()): the next one waits for it.
  PENDULA_INLINE point at_end() const { return after_units(S(length_)); }
  state state_of(const point& there) const { return system_.from_canonical(there.head); }
  state head_of(const state& y) const { return system_.canonical(y); }

  const Sys& of() const { return system_; }
  std::int64_t evaluations(int = 0) const { return expansions_; }

  // Takes the trajectory of another stepper into a lane.
  template <class Other>
  void take(int l, const Other& from) {
    set_lanes(system_, l, from.system_);
    set_lanes(at_, l, from.at_);
    set_lane(longest_, l, from.longest_);
    set_lane(unit_, l, from.unit_);
    set_lane(in_units_, l, from.in_units_);
    for (std::size_t k = 1; k < inverse_.size(); ++k) set_lane(inverse_[k], l, from.inverse_[k]);
    set_lane(log2_of_scale_, l, from.log2_of_scale_);
  }

  // What the motion in a lane is as large as, in radians, and its highest frequency.
  double amplitude(int l = 0) const { return rough_exp2(lane(log2_of_scale_, l)); }
  double frequency(int l = 0) const { return longest_phase_ / (lane(longest_, l) * lane(unit_, l)); }

  // Of the step's motion in a lane, on [0, 1] for the whole of it. The velocity's has what the series does not know of
  // the velocity at the step's end as its last order: there it goes on in the next step without a gap, which might
  // hide a zero or show one twice.
  polynomial angle_polynomial(int i, int l = 0) const {
    polynomial p;
    p.degree = order_;
    p.coefficient[0] = lane(at_.head[i], l);
    double power = 1.0;
    for (int k = 1; k <= order_; ++k)
      p.coefficient[k] = lane(series_.velocity(i, k - 1) * inverse_[k], l) * (power *= lane(length_, l));
    return p;
  }
  polynomial velocity_polynomial(int i, int l = 0) const {
    const int orders = std::min(order_, most_coefficients - 1);  // of those beyond, a double sees nothing
    polynomial p;
    p.degree = orders - 1;
    double power = 1.0;
    for (int k = 0; k < orders; ++k, power *= lane(length_, l))
      p.coefficient[k] = lane(rough(series_.velocity(i, k)), l) * power;
    const double at_end = lane(rough(velocity_at_end(i)), l);
    p.coefficient[orders] = at_end - p(1.0);
    p.degree = orders;
    return p;
  }

  // Angle and velocity at the start of the step, and how far from there they can be in it.
  S angle(int i) const { return at_.head[i]; }
  S velocity(int i) const { return series_.velocity(i, 0); }
  PENDULA_INLINE S angle_reach(int i) const {
    const S h = magnitude(length_);
    S sum(0.0);
    for (int k = order_; k >= 1; --k) sum = (sum + magnitude(series_.velocity(i, k - 1)) * inverse_[k]) * h;
    return sum;
  }
  PENDULA_INLINE S velocity_reach(int i) const {
    const S h = magnitude(length_);
    S sum(0.0);
    for (int k = order_ - 1; k >= 1; --k) sum = (sum + magnitude(series_.velocity(i, k))) * h;
    return sum + magnitude(velocity_at_end(i) - velocity_of_series(i));
  }

 private:
  PENDULA_INLINE point after_units(S tau) const { return at_.moved_by(series_.increment(tau, inverse_.data())); }
  S velocity_at_end(int i) const { return state_of(at_end())[degrees_of_freedom<Sys> + i]; }
  S velocity_of_series(int i) const {
    S sum = series_.velocity(i, order_ - 1);
    for (int k = order_ - 2; k >= 0; --k) sum = sum * S(length_) + series_.velocity(i, k);
    return sum;
  }

  // The least of four, where the next step waits for it: it has an error of a logarithm divided by the order. One
  // trajectory has the four side by side, in lanes.
  PENDULA_INLINE R coarse_log2_of_radius() const {
    const auto radius = [&](const auto& size, const auto& per_order) {
      using T = std::remove_cvref_t<decltype(size)>;
      const T radius = (T(log2_of_scale_) - coarse_log2(size)) * per_order;
      return choose(less(T(500.0), radius), T(500.0), radius);
    };
    const auto lesser = [](const auto& a, const auto& b) { return choose(less(a, b), a, b); };
    const auto size = [&](int i) {
      return rough(series_.velocity(0, order_ - 4 + i)) * rough(inverse_[order_ - 3 + i]);
    };
    if constexpr (std::same_as<R, double>) {
      const auto [one, other] =
          halves(radius(lanes_of(size(0), size(1), size(2), size(3)), pack<double, 4>(per_order_)));
      const auto both = lesser(one, other);
      return lesser(both[0], both[1]);
    } else {
      R least = radius(size(0), R(per_order_[0]));
      for (int i = 1; i < 4; ++i) least = lesser(least, radius(size(i), R(per_order_[i])));
      return least;
    }
  }

  // log2 |θ_k|, of the angle where it is largest.
  PENDULA_INLINE R log2_of_size(int k) const {
    constexpr int freedom = degrees_of_freedom<Sys>;
    if constexpr (has_double_precision<S>) {
      R largest = magnitude(rough(series_.velocity(0, k - 1)));
      for (int i = 1; i < freedom; ++i) {
        const R other = magnitude(rough(series_.velocity(i, k - 1)));
        largest = choose(less(largest, other), other, largest);
      }
      return rough_log2(largest * rough(inverse_[k]));
    } else {  // whose exponents can be beyond those of a double
      R largest = rough_log2(series_.velocity(0, k - 1));
      for (int i = 1; i < freedom; ++i) {
        const R other = rough_log2(series_.velocity(i, k - 1));
        largest = choose(less(largest, other), other, largest);
      }
      return largest + rough_log2(inverse_[k]);
    }
  }
  PENDULA_INLINE R log2_of_radius(int k) const {
    const R radius = (log2_of_scale_ - log2_of_size(k)) * R(1.0 / k);
    return choose(less(R(500.0), radius), R(500.0), radius);  // a power of two can be made of that
  }

  template <Analytic>
  friend class taylor_stepper;

  Sys system_{};
  int order_;
  typename Sys::series series_;
  std::vector<S> inverse_;     // unit/k
  double log2_of_reach_;       // of the error allowed, a part in the order: 32 times below the tolerance
  pack<double, 4> per_order_;  // of the last four
  // a little more than the step of a small swing with the highest frequency: for what has no last terms, such as rest
  double longest_phase_;
  // of time, in seconds: a power of two; the lengths are in parts of it
  R unit_, in_units_;
  R longest_, log2_of_scale_, length_;
  std::int64_t expansions_ = 0;
  point at_;
  [[no_unique_address]] joints_of<Sys> joints_;
};

struct taylor {
  static constexpr std::string_view name = "taylor";
  static constexpr int order = 20;                // at the best tolerance
  static constexpr int evaluations_per_step = 1;  // of the series
  static constexpr bool adaptive = true, symplectic = false;
  static constexpr facet needs = facet::analytic;
  static constexpr std::string_view source = "Jorba & Zou, Exp. Math. 14 (2005) 99";

  template <Analytic Sys>
  using stepper = taylor_stepper<Sys>;
};

}  // namespace pendula::inline PENDULA_MACHINE
