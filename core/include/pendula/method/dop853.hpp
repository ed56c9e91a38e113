// DOP853: a Runge–Kutta step of order 8 that estimates its error and is made again, shorter, where that is too large,
// and a polynomial of degree 7 through it (Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I,
// II.4 to II.6, II.10, and their dop853.f).
#pragma once

#include <limits>

#include "pendula/description.hpp"
#include "pendula/method/amplitude.hpp"
#include "pendula/method/dop853_step.hpp"
#include "pendula/scalar/compensated.hpp"
#include "pendula/scalar/polynomial_roots.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

template <Energetic Sys>
class dop853_stepper {
 public:
  using S = typename Sys::scalar;
  using state = typename Sys::state;
  using point = compensated_point<state>;
  static constexpr double precision_inside = 0x1p-30;  // of the motion inside a step, in parts of its change
  static_assert(has_double_precision<S>, "the coefficients are known to as many digits as a double has");

  [[gnu::noinline]] dop853_stepper(const Sys& system, double log2_of_tolerance)
      : tolerance_(rough_exp2(log2_of_tolerance)) {
    change(system);
  }

  // Takes another system.
  void change(const Sys& system) {
    system_ = system;
    frequency_ = square_root(system.largest_frequency_squared());
    const S period = S(6.283185307179586) / frequency_;
    shortest_ = S(0x1p-40) * period;
    longest_ = period;  // also at rest, where no error limits it
  }

  // Places the motion at a state (θ…, ω…) at time t. Errors are in parts of a radian, or of the amplitude of a small
  // swing, and of the angle where it is larger; those of velocities alike, with the largest frequency.
  void start(const S& t, const state& y) {
    now_.joints.start(system_, t, y);
    now_.at.head = y;
    now_.at.tail.fill(S(0.0));
    now_.slope = slope_of(system_, t, y);
    now_.step = S(0.0);
    const S squared = amplitude_squared(system_, y), log2_of_size = log2_of_amplitude(system_, y);
    const auto small = mask_and(less(S(0.0), squared), less(squared, S(1.0)));
    const auto tiny = less(log2_of_size, S(-400.0));
    now_.enlarged = choose(tiny, S(0x1p400), S(1.0));
    const S enlarged = rough_exp2(log2_of_size + S(400.0)), least = S(0x1p-670) / tolerance_;
    const S of_tiny = choose(less(enlarged, least), least, enlarged);  // no error is smaller than the smallest number
    now_.size = choose(tiny, of_tiny, choose(small, square_root(squared), S(1.0)));
    evaluations_ = S(1.0);
    extra_evaluations_ = S(0.0);
  }

  // Where the motion is, and all that the next steps depend on: doubles, or lanes of them, alone.
  struct memory {
    point at;
    state slope;
    S step;  // to be tried next, without its sign; 0: none is known yet
    // Of the motion, in radians, so many times enlarged: of the smallest swings, the inverse of an error allowed would
    // be no number.
    S size, enlarged;
    [[no_unique_address]] joints_of<Sys> joints;
  };
  const memory& remembered() const { return now_; }
  const point& here() const { return now_.at; }
  void resume(const memory& from) {
    now_ = from;
    now_.joints.tell(system_);
  }

  // Of a system in pieces: goes on from a point at time t with other joints.
  const joints_of<Sys>& joints() const { return now_.joints; }
  void begin_piece(const S& t, const point& from, const joints_of<Sys>& joints) {
    resume({from, {}, proposed_, now_.size, now_.enlarged, joints});
    now_.slope = slope_of(system_, t, from.head);
  }
  // On to the end of the step: `next` is what at_end() says.
  PENDULA_INLINE void proceed(const point& next) {
    now_ = {next, engine::unpaired(k_[last]), proposed_, now_.size, now_.enlarged, now_.joints};
    now_.joints.move_on();
  }

  // Takes the trajectory of another stepper into a lane.
  template <class Other>
  void take(int l, const Other& from) {
    set_lanes(system_, l, from.system_);
    set_lanes(now_, l, from.now_);
    set_lane(frequency_, l, from.frequency_);
    set_lane(shortest_, l, from.shortest_);
    set_lane(longest_, l, from.longest_);
    set_lane(evaluations_, l, from.evaluations_);
    set_lane(extra_evaluations_, l, 0.0);
  }

  // Makes a step from time t, forward or (direction −1) backward. Lanes whose step is accepted repeat it, to the same
  // bits, until all others have theirs. A step that would have to be too short, or is not of numbers, leads to no
  // number.
  PENDULA_INLINE void expand(const head_and_tail<S>& t, double direction) {
    time_ = t.head;
    const components y = engine::paired(now_.at.head), inverse_scale = engine::paired(inverse_of_error_allowed());
    S h = now_.step;
    if (any_lane(equal(h, S(0.0)))) h = choose(equal(h, S(0.0)), first_step(direction, y, inverse_scale), h);
    k_[0] = engine::paired(now_.slope);
    auto pending = equal(S(0.0), S(0.0)), rejected = mask_not(pending);
    for (;;) {
      evaluations_ = evaluations_ + choose(pending, S(dop853_table::stages - 1.0), S(0.0));
      length_ = S(direction) * h;
      increment_ = engine::increment(system_, time_, y, k_, length_);
      const estimate error = estimated(inverse_scale);
      pending = mask_and(mask_not(error.accepted), less(shortest_, h));
      if (!any_lane(pending)) {
        settle(h, error.factor, rejected);
        return;
      }
      rejected = mask_not(mask_and(mask_not(rejected), mask_not(pending)));
      h = choose(pending, h * error.factor, h);
    }
  }
  S length() const { return length_; }

  // The point a time tau into the step.
  PENDULA_INLINE point after(S tau) const { return all_lanes(equal(tau, length_)) ? result_ : within(tau); }
  PENDULA_INLINE point at_end() const { return result_; }
  state state_of(const point& there) const { return there.head; }
  state head_of(const state& y) const { return y; }

  const Sys& of() const { return system_; }
  // Of the right-hand side, those of rejected steps included.
  std::int64_t evaluations(int of_lane = 0) const {
    return static_cast<std::int64_t>(lane(evaluations_, of_lane) + lane(extra_evaluations_, of_lane));
  }

  // What the motion is as large as, in radians, and its highest frequency.
  double amplitude() const { return now_.size / now_.enlarged; }
  double frequency() const { return frequency_; }

  // Of the step's motion, on [0, 1] for the whole of it.
  polynomial angle_polynomial(int i) const { return component_polynomial(static_cast<std::size_t>(i)); }
  polynomial velocity_polynomial(int i) const { return component_polynomial(static_cast<std::size_t>(i) + freedom); }

 private:
  static constexpr std::size_t last = dop853_table::stages, freedom = degrees_of_freedom<Sys>;

  using engine = dop853_step<Sys>;
  using number = typename engine::number;
  using components = typename engine::components;

  struct estimate {
    decltype(equal(S(0.0), S(0.0))) accepted;
    S factor;  // to the length of the step that would just be accepted, with some safety
  };

  PENDULA_INLINE state inverse_of_error_allowed() const {
    state inverse;
    for (std::size_t i = 0; i < inverse.size(); ++i) {
      const S size = i < freedom ? now_.size : frequency_ * now_.size;
      inverse[i] = S(1.0) / (tolerance_ * (size + now_.enlarged * magnitude(now_.at.head[i])));
    }
    return inverse;
  }
  PENDULA_INLINE S squares(const components& error, const components& inverse_scale) const {
    const S sum = engine::sum_of_squares(engine::each([&]<std::size_t i> { return error[i] * inverse_scale[i]; }));
    return sum * (now_.enlarged * now_.enlarged);
  }

  // Error = e5² / √(n (e5² + 0.01 e3²)) of both estimates in parts of what is allowed (Hairer, Nørsett & Wanner 1993,
  // II.10), and the next step 0.9 / error^(1/8) as long, but at least 1/3, and at most 6 times (dop853.f).
  PENDULA_INLINE estimate estimated(const components& inverse_scale) const {
    const components fifth = engine::template sum<dop853_table::error, 0>(k_, number(length_)),
                     other = engine::template sum<dop853_table::error, 1>(k_, number(length_));
    const S e5 = squares(fifth, inverse_scale);
    const S e3 = squares(engine::each([&]<std::size_t i> { return increment_[i] - other[i]; }), inverse_scale);
    const S sum = S(static_cast<double>(Sys::dimension)) * (e5 + S(0.01) * e3);
    const S below = choose(equal(sum, S(0.0)), S(1.0), sum);
    const S log2_of_error = rough_log2(e5) - S(0.5) * rough_log2(below);
    const S wanted = S(-0.15200309344504995) - S(0.125) * log2_of_error;  // log2 of 0.9
    const S least(-1.584962500721156), most(2.584962500721156);           // log2 of 1/3 and 6
    const S from_below = choose(less(wanted, least), least, wanted);
    return {less(e5 * e5, below), rough_exp2(choose(less(most, from_below), most, from_below))};
  }

  // A first guess from the slope, and how it changes over a short step of Euler's (Hairer, Nørsett & Wanner 1993,
  // II.4), with the time that belongs to the largest frequency as unit.
  [[gnu::noinline]] S first_step(double direction, const components& y, const components& inverse_scale) {
    const S unit = S(1.0) / frequency_;
    const components from = engine::paired(now_.slope);
    const S of_state = squares(y, inverse_scale), of_slope = squares(from, inverse_scale) * (unit * unit);
    const auto large = mask_and(less(S(1e-10), of_state), less(S(1e-10), of_slope));
    const S h0 = choose(large, S(0.01) * square_root(of_state / of_slope), S(1e-6));
    const S length = S(direction) * h0 * unit;
    const number h(length);
    const components slope = engine::paired(slope_of(
        system_, time_ + length, engine::unpaired(engine::each([&]<std::size_t i> { return y[i] + h * from[i]; }))));
    evaluations_ = evaluations_ + choose(equal(now_.step, S(0.0)), S(1.0), S(0.0));
    const components change = engine::each([&]<std::size_t i> { return slope[i] - from[i]; });
    const S of_change = squares(change, inverse_scale) * (unit * unit);
    const S curvature = of_change / (h0 * h0);
    const S larger = choose(less(of_slope, curvature), curvature, of_slope);
    const S h1 = rough_exp2(S(-0.830482023721841) - S(0.0625) * rough_log2(larger));  // (0.01 / √larger)^(1/8)
    return limited(choose(less(S(100.0) * h0, h1), S(100.0) * h0, h1) * unit);
  }
  PENDULA_INLINE S limited(S h) const { return choose(less(h, longest_), h, longest_); }

  // After the steps that were accepted: the points they lead to, and how long the next ones should be.
  PENDULA_INLINE void settle(S h, S factor, decltype(estimate::accepted) rejected) {
    const number or_none(choose(less(shortest_, h), S(1.0), S(std::numeric_limits<double>::quiet_NaN())));
    increment_ = engine::each([&]<std::size_t i> { return increment_[i] * or_none; });
    const compensated_point<components> from{engine::paired(now_.at.head), engine::paired(now_.at.tail)};
    const auto to = from.moved_by(increment_);
    result_ = {engine::unpaired(to.head), engine::unpaired(to.tail)};
    k_[last] = engine::paired(slope_of(system_, time_ + length_, result_.head));
    evaluations_ = evaluations_ + S(1.0) + extra_evaluations_;
    extra_evaluations_ = S(0.0);
    dense_known_ = false;
    proposed_ = limited(h * choose(mask_and(rejected, less(S(1.0), factor)), S(1.0), factor));
  }

  [[gnu::noinline]] point within(S tau) const {
    if (!dense_known_) find_dense();
    const auto whole = equal(tau, length_);
    // lanes that are not asked are given the start of their step
    extra_evaluations_ = choose(mask_or(whole, equal(tau, S(0.0))), extra_evaluations_, S(3.0));
    const S x = tau / length_, rest = S(1.0) - x;
    state increment;
    for (std::size_t i = 0; i < increment.size(); ++i) {
      S sum = dense_[6][i];
      for (int j = 5; j >= 0; --j) sum = dense_[j][i] + (j % 2 == 1 ? x : rest) * sum;
      increment[i] = x * sum;
    }
    point there = now_.at.moved_by(increment);
    for (std::size_t i = 0; i < increment.size(); ++i) {
      there.head[i] = choose(whole, result_.head[i], there.head[i]);
      there.tail[i] = choose(whole, result_.tail[i], there.tail[i]);
    }
    return there;
  }

  // The coefficients of y + x (d0 + (1 − x) (d1 + x (d2 + (1 − x) (d3 + …)))) (dop853.f: contd8).
  [[gnu::noinline]] void find_dense() const {
    const number h(length_);
    const components y = engine::paired(now_.at.head);
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (engine::template add_slope<last + 1 + i>(system_, time_, y, k_, length_), ...);
    }(std::make_index_sequence<3>{});
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      ((dense_[3 + i] = engine::unpaired(engine::template sum<dop853_table::dense, i>(k_, h))), ...);
    }(std::make_index_sequence<4>{});
    const components& d0 = increment_;
    const components d1 = engine::each([&]<std::size_t i> { return h * k_[0][i] - d0[i]; });
    dense_[0] = engine::unpaired(d0);
    dense_[1] = engine::unpaired(d1);
    dense_[2] = engine::unpaired(engine::each([&]<std::size_t i> { return (d0[i] - h * k_[last][i]) - d1[i]; }));
    dense_known_ = true;
  }

  polynomial component_polynomial(std::size_t i) const {
    if (!dense_known_) find_dense();
    extra_evaluations_ = S(3.0);
    std::array<double, 7> coefficients;
    for (std::size_t j = 0; j < coefficients.size(); ++j) coefficients[j] = dense_[j][i];
    return dense_polynomial(now_.at.head[i], coefficients);
  }

  template <Energetic>
  friend class dop853_stepper;

  Sys system_{};
  S tolerance_, frequency_, shortest_, longest_;
  memory now_;
  S time_, length_, proposed_;
  components increment_;
  point result_;
  S evaluations_{0.0};
  // worked out when they are first asked for
  mutable typename engine::slopes k_;
  mutable std::array<state, 7> dense_;
  mutable bool dense_known_ = false;
  mutable S extra_evaluations_{0.0};
};

struct dop853 {
  static constexpr std::string_view name = "dop853";
  static constexpr int order = 8;
  static constexpr int evaluations_per_step = 12;  // the last slope of a step is the first of the next
  static constexpr bool adaptive = true, symplectic = false;
  static constexpr facet needs = facet::energetic;
  static constexpr std::string_view source = "Hairer, Nørsett & Wanner (1993), dop853.f";

  template <Energetic Sys>
  using stepper = dop853_stepper<Sys>;
};

}  // namespace pendula::inline PENDULA_MACHINE
