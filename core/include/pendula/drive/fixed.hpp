// The fixed-step drive: a grid t0 + n h, outputs on it or one shortened step off it.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pendula/drive/fixed_kernels.hpp"
#include "pendula/drive/outcome.hpp"
#include "pendula/scalar/pack.hpp"

namespace pendula {

// An output is the state after `steps` whole steps from t0 and, where `rest` is not 0, one step of that length.
using fixed_output = pendula_kernels::fixed_place;

inline constexpr double on_grid = 1e-9;       // of a step: nearer outputs are taken to lie on the grid
inline constexpr double most_steps = 0x1p53;  // whole numbers are exact up to here

// Where time t lies on the grid of steps h (negative: backward) from t0. |t − t0| / |h| must not pass most_steps.
inline fixed_output place_on_grid(double t, double t0, double h) {
  const double position = (t - t0) / h, nearest = std::nearbyint(position);
  // a step such as 1e-5 is itself rounded: after many of them a multiple of it is off by as many roundings
  if (std::fabs(position - nearest) <= on_grid + 0x1p-52 * std::fabs(nearest))
    return {static_cast<std::int64_t>(nearest), 0.0};
  const double whole = std::floor(position);
  return {static_cast<std::int64_t>(whole), (t - t0) - whole * h};
}

struct fixed_plan {
  std::vector<double> times;
  std::vector<fixed_output> outputs;
};

// Outputs at the times asked for, which follow one another in the direction of the step.
inline fixed_plan requested_times(double t0, double step, std::span<const double> times) {
  fixed_plan plan{{times.begin(), times.end()}, {}};
  plan.outputs.reserve(times.size());
  for (double t : times) plan.outputs.push_back(place_on_grid(t, t0, step));
  return plan;
}

// Outputs at the method's own steps from t0 to `end`, the last of them shortened where the grid misses it.
inline fixed_plan own_steps(double t0, double step, double end) {
  const fixed_output last = place_on_grid(end, t0, step);
  fixed_plan plan;
  for (std::int64_t n = 0; n <= last.steps; ++n) {
    plan.times.push_back(t0 + static_cast<double>(n) * step);
    plan.outputs.push_back({n, 0.0});
  }
  if (last.rest != 0.0) {
    plan.times.push_back(end);
    plan.outputs.push_back(last);
  }
  plan.times.back() = end;
  return plan;
}

// Per lane: how it ended, how many outputs are its own, the steps it took, whole and shortened, and their evaluations.
struct lane_result {
  outcome ended = outcome::reached_end;
  std::size_t outputs = 0;
  std::int64_t steps = 0, evaluations = 0;
};

// Of what a method carries from step to step the drive asks whether it is finite, and that a lane forget where it was.
// The plain state answers here, the rest next to their methods.
template <class S, std::size_t dimension>
PENDULA_INLINE const vec<S, dimension>& head_of(const vec<S, dimension>& y) {
  return y;
}
template <class S, std::size_t dimension>
void lay_to_rest(vec<S, dimension>& y, int i) {
  for (S& component : y) set_lane(component, i, 0.0);
}

template <class Method, SystemOver Sys>
  requires StepsOver<Method, Sys>
class fixed_run {
 public:
  using S = typename Sys::scalar;
  using state = typename Sys::state;
  static constexpr int width = lanes<S>::count;
  using results = std::array<lane_result, width>;

  fixed_run(const Sys& system, const state& start, double step, std::int64_t step_limit)
      : system_(system), start_(start), at_(Method::begin(system, start)), step_(step), step_limit_(step_limit) {}

  // Runs through `outputs` (their steps do not decrease) and hands each state to sink(index, state); a lane that
  // has ended hands on NaN. go_on(steps taken) is asked every 2^14 steps; false ends the run as interrupted.
  template <class Sink, class Poll>
  results through(std::span<const fixed_output> outputs, Sink&& sink, Poll&& go_on) {
    end_lanes_not_finite(head_of(at_));
    for (std::size_t i = 0; i < outputs.size() && running_ > 0; ++i) {
      if (!advance(outputs[i].steps, go_on)) break;
      if (outputs[i].rest == 0.0) {
        deliver(i, steps_ == 0 ? start_ : Method::state_of(system_, at_), sink);  // at t0 as it was given
      } else if (steps_ + shortened_ < step_limit_) {
        deliver(i, after_shortened_step(outputs[i].rest), sink);
      } else {
        end_all(outcome::step_limit);
      }
    }
    end_all(outcome::reached_end);
    return results_;
  }

  // Hands on the state after each step by visit(number, state), and that of the last place where it is off the grid,
  // until one of them says false.
  template <class Visit>
  void each_step(fixed_output last, Visit&& visit) {
    for (std::int64_t n = 1; n <= last.steps; ++n) {
      take_steps(at_, S(step_), 1);
      if (!visit(n, Method::state_of(system_, at_))) return;
    }
    if (last.rest != 0.0) visit(last.steps + 1, after_shortened_step(last.rest));
  }

 private:
  using carried = decltype(Method::begin(std::declval<const Sys&>(), std::declval<const state&>()));
  static constexpr std::int64_t between_polls = std::int64_t{1} << 14;

  // False where every lane has ended on the way.
  template <class Poll>
  bool advance(std::int64_t target, Poll&& go_on) {
    while (steps_ < target) {
      const std::int64_t due = steps_ - steps_ % between_polls + between_polls;
      const std::int64_t until = std::min({target, step_limit_ - shortened_, due});
      if (until == steps_) {
        end_all(outcome::step_limit);
      } else {
        step_until(until);
        if (steps_ == due && !go_on(steps_)) end_all(outcome::interrupted);
      }
      if (running_ == 0) return false;
    }
    return true;
  }

  state after_shortened_step(double h) {
    carried there = at_;
    take_steps(there, S(h), 1);
    ++shortened_;
    if constexpr (Method::evaluations_per_step == 0)
      for (int i = 0; i < width; ++i) elsewhere_[i] += evaluations_of(there, i) - evaluations_of(at_, i);
    end_lanes_not_finite(head_of(there));
    return Method::state_of(system_, there);
  }

  void step_until(std::int64_t until) {
    while (steps_ < until && running_ > 0) {
      steps_ += take_steps(at_, S(step_), until - steps_);
      end_lanes_not_finite(head_of(at_));
    }
  }

  // The loop all the time is spent in. It stops early only where a lane is not finite, and tells how many it took.
  [[gnu::noinline]] std::int64_t take_steps(carried& from, S h, std::int64_t most) const {
    carried at = from;
    std::int64_t n = 0;
    do {
      at = Method::step(system_, at, h);
      ++n;
    } while (all_lanes(finite<S>(head_of(at))) && n < most);
    from = at;
    return n;
  }

  void end_lanes_not_finite(const state& y) {
    const auto well = finite<S>(y);
    for (int i = 0; i < width; ++i)
      if (!lane_of(well, i)) end_lane(i, outcome::not_finite);
  }

  // The lane is laid to rest at the lowest point, where it stays and disturbs nobody.
  void end_lane(int i, outcome how) {
    if (ended_[i]) return;
    ended_[i] = true;
    --running_;
    results_[i].ended = how;
    results_[i].steps = steps_ + shortened_;
    if constexpr (Method::evaluations_per_step == 0) {
      results_[i].evaluations = evaluations_of(at_, i) + elsewhere_[i];
    } else {
      results_[i].evaluations = Method::evaluations_per_step * results_[i].steps;
    }
    lay_to_rest(at_, i);
  }

  void end_all(outcome how) {
    for (int i = 0; i < width; ++i) end_lane(i, how);
  }

  template <class Sink>
  void deliver(std::size_t index, state y, Sink&& sink) {
    end_lanes_not_finite(y);
    for (int i = 0; i < width; ++i) {
      if (ended_[i]) {
        for (S& component : y) set_lane(component, i, __builtin_nan(""));
      } else {
        results_[i].outputs = index + 1;
      }
    }
    if (running_ > 0) sink(index, y);
  }

  const Sys& system_;
  state start_;
  carried at_;
  double step_;
  std::int64_t step_limit_, steps_ = 0, shortened_ = 0;
  std::array<std::int64_t, width> elsewhere_{};  // evaluations of shortened steps
  int running_ = width;
  std::array<bool, width> ended_{};
  results results_{};
};

}  // namespace pendula
