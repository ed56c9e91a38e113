// The fixed-step drive: steps from a grid time t0 + n h to the next, for one trajectory or lanes of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pendula/drive/fixed_grid.hpp"
#include "pendula/drive/outcome.hpp"
#include "pendula/drive/polling.hpp"
#include "pendula/scalar/pack.hpp"

namespace pendula::inline PENDULA_MACHINE {

// Per lane: how it ended, how many outputs are its own, the steps it took, whole and shortened, their evaluations, and
// how many steps on the grid it came.
struct lane_result {
  outcome ended = outcome::reached_end;
  std::size_t outputs = 0;
  std::int64_t steps = 0, evaluations = 0, grid_steps = 0;
};

// Of what a method carries from step to step the drive asks whether it is finite, and that a lane forget where it was.
// The plain state answers here, the rest next to their methods.
template <class S, std::size_t dimension>
PENDULA_INLINE const vec<S, dimension>& head_of(const vec<S, dimension>& y) {
  return y;
}
template <class S, std::size_t dimension>
void retire_lane(vec<S, dimension>& y, int i) {
  for (S& component : y) set_lane(component, i, 0.0);
}

template <class Method, Flow Sys>
  requires StepsOver<Method, Sys>
class fixed_run {
 public:
  using S = typename Sys::scalar;
  using state = typename Sys::state;
  static constexpr int width = lanes<S>::count;
  using results = std::array<lane_result, width>;

  // From a state at time t0.
  fixed_run(const Sys& system, const state& start, double t0, double step, std::int64_t step_limit)
      : system_(system),
        start_(start),
        at_(Method::begin(system, start)),
        t0_(t0),
        step_(step),
        step_limit_(step_limit) {}

  // Runs through `outputs` (their steps do not decrease) and passes each state to sink(index, state), NaN for
  // a lane that has ended. go_on(steps taken) is asked now and then; false ends the run as interrupted.
  template <class Sink, class Poll>
  results through(std::span<const fixed_output> outputs, Sink&& sink, Poll&& go_on) {
    end_lanes_not_finite(head_of(at_));
    for (std::size_t i = 0; i < outputs.size() && running_ > 0; ++i) {
      if (!advance(outputs[i].steps, go_on)) break;
      if (outputs[i].rest == 0.0) {
        deliver(i, steps_ == 0 ? start_ : Method::state_of(system_, at_), sink);  // at t0 the given state
      } else if (steps_ + shortened_ < step_limit_) {
        deliver(i, after_shortened_step(outputs[i].rest), sink);
      } else {
        end_all(outcome::step_limit);
      }
    }
    end_all(outcome::reached_end);
    return results_;
  }

  // For one trajectory that goes on as often as it is asked: to so many steps on the grid in all, no fewer than it
  // took; false where its numbers are not finite.
  bool go_to(std::int64_t steps) {
    while (steps_ < steps && lane_of(finite<S>(head_of(at_)), 0)) steps_ += take_steps(at_, S(step_), steps - steps_);
    return lane_of(finite<S>(head_of(at_)), 0);
  }
  std::int64_t steps() const { return steps_; }
  // The state there, or one step of the length `rest` later.
  state beside(double rest) const {
    if (rest == 0.0) return steps_ == 0 ? start_ : Method::state_of(system_, at_);
    carried there = at_;
    take_steps(there, S(rest), 1);
    return Method::state_of(system_, there);
  }

 private:
  using carried = decltype(Method::begin(std::declval<const Sys&>(), std::declval<const state&>()));

  // False where every lane has ended on the way.
  template <class Poll>
  bool advance(std::int64_t target, Poll&& go_on) {
    while (steps_ < target) {
      const std::int64_t due = steps_ - steps_ % fixed_steps_between_polls + fixed_steps_between_polls;
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

  // The loop all the time is spent in. It stops early only where a lane is not finite, and returns the number of steps.
  [[gnu::noinline]] std::int64_t take_steps(carried& from, S h, std::int64_t most) const {
    carried at = from;
    std::int64_t n = 0;
    do {
      // on the grid; what does not depend on time has no use for it, and the compiler leaves it out
      const double t = t0_ + static_cast<double>(steps_ + n) * step_;
      at = Method::step(system_, S(t), at, h);
      ++n;
    } while (all_lanes(finite<S>(head_of(at))) && n < most);
    from = at;
    return n;
  }

  void end_lanes_not_finite(const state& y) {
    const auto sound = finite<S>(y);
    for (int i = 0; i < width; ++i)
      if (!lane_of(sound, i)) end_lane(i, outcome::not_finite);
  }

  // A lane that has ended is set to rest at the lowest point, where it stays.
  void end_lane(int i, outcome how) {
    if (ended_[i]) return;
    ended_[i] = true;
    --running_;
    results_[i].ended = how;
    results_[i].steps = steps_ + shortened_;
    results_[i].grid_steps = steps_;
    if constexpr (Method::evaluations_per_step == 0) {
      results_[i].evaluations = evaluations_of(at_, i) + elsewhere_[i];
    } else {
      results_[i].evaluations = Method::evaluations_per_step * results_[i].steps;
    }
    retire_lane(at_, i);
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
  double t0_, step_;
  std::int64_t step_limit_, steps_ = 0, shortened_ = 0;
  std::array<std::int64_t, width> elsewhere_{};  // evaluations of shortened steps
  int running_ = width;
  std::array<bool, width> ended_{};
  results results_{};
};

}  // namespace pendula::inline PENDULA_MACHINE
