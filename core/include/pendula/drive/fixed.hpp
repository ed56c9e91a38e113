// The fixed-step drive: steps from a grid time t0 + n h to the next, for one trajectory or lanes of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

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

// The drive of all methods and systems of so many components: what it needs of a method it asks below. Compiled once,
// it takes a third off the time that they take to compile.
template <class S, std::size_t dimension>
class fixed_drive {
 public:
  using state = vec<S, dimension>;
  static constexpr int width = lanes<S>::count;
  using results = std::array<lane_result, width>;

  virtual ~fixed_drive() = default;
  virtual std::unique_ptr<fixed_drive> copy() const = 0;

  // Runs through `outputs` (their steps do not decrease) and passes each state to sink(index, state), NaN for
  // a lane that has ended. go_on(steps taken) is asked now and then; false ends the run as interrupted.
  template <class Sink, class Poll>
  results through(std::span<const fixed_output> outputs, Sink&& sink, Poll&& go_on) {
    end_lanes_not_finite(head());
    for (std::size_t i = 0; i < outputs.size() && running_ > 0; ++i) {
      if (!advance(outputs[i].steps, go_on)) break;
      if (outputs[i].rest == 0.0) {
        deliver(i, here(), sink);
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
    while (steps_ < steps && lane_of(finite<S>(head()), 0)) steps_ += take_steps(steps - steps_);
    return lane_of(finite<S>(head()), 0);
  }
  std::int64_t steps() const { return steps_; }
  // The state there, or one step of the length `rest` later.
  state beside(double rest) const { return rest == 0.0 ? here() : after_step(rest).here; }

 protected:
  struct place {
    state head, here;
    std::array<std::int64_t, width> evaluations;  // of the step that led there
  };

  // From a state at time t0.
  fixed_drive(const state& start, double t0, double step, std::int64_t step_limit)
      : start_(start), t0_(t0), step_(step), step_limit_(step_limit) {}

  // On the grid, at most so many and fewer only where a lane is not finite then; how many it took.
  virtual std::int64_t take_steps(std::int64_t most) = 0;
  virtual place after_step(double h) const = 0;
  virtual state head() const = 0;  // of what the method carries: finite where all of it is
  virtual state state_here() const = 0;
  virtual std::int64_t evaluations(int lane) const = 0;  // of the steps on the grid
  virtual void retire(int lane) = 0;                     // sets it to rest at the lowest point

  // On the grid; what does not depend on time has no use for it, and the compiler leaves it out.
  double time_after(std::int64_t more) const { return t0_ + static_cast<double>(steps_ + more) * step_; }
  double step() const { return step_; }

 private:
  // At t0 the given state.
  state here() const { return steps_ == 0 ? start_ : state_here(); }

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
    const place there = after_step(h);
    ++shortened_;
    for (int i = 0; i < width; ++i) elsewhere_[i] += there.evaluations[i];
    end_lanes_not_finite(there.head);
    return there.here;
  }

  void step_until(std::int64_t until) {
    while (steps_ < until && running_ > 0) {
      steps_ += take_steps(until - steps_);
      end_lanes_not_finite(head());
    }
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
    results_[i].evaluations = evaluations(i) + elsewhere_[i];
    retire(i);
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

  state start_;
  double t0_, step_;
  std::int64_t step_limit_, steps_ = 0, shortened_ = 0;
  std::array<std::int64_t, width> elsewhere_{};  // evaluations of shortened steps
  int running_ = width;
  std::array<bool, width> ended_{};
  results results_{};
};

template <class Method, Flow Sys>
  requires StepsOver<Method, Sys>
class fixed_run final : public fixed_drive<typename Sys::scalar, Sys::dimension> {
 public:
  using S = typename Sys::scalar;
  using drive = fixed_drive<S, Sys::dimension>;
  using state = typename drive::state;

  // From a state at time t0.
  fixed_run(const Sys& system, const state& start, double t0, double step, std::int64_t step_limit)
      : drive(start, t0, step, step_limit), system_(system), at_(Method::begin(system, start)) {}

  [[gnu::cold]] std::unique_ptr<drive> copy() const override { return std::make_unique<fixed_run>(*this); }

 private:
  using carried = decltype(Method::begin(std::declval<const Sys&>(), std::declval<const state&>()));
  static constexpr bool counts_itself = Method::evaluations_per_step == 0;

  std::int64_t take_steps(std::int64_t most) override { return take_steps_of(S(this->step()), at_, most); }
  typename drive::place after_step(double h) const override {
    carried there = at_;
    take_steps_of(S(h), there, 1);
    typename drive::place found{head_of(there), Method::state_of(system_, there), {}};
    for (int i = 0; i < drive::width; ++i) {
      if constexpr (counts_itself) {
        found.evaluations[i] = evaluations_of(there, i) - evaluations_of(at_, i);
      } else {
        found.evaluations[i] = Method::evaluations_per_step;
      }
    }
    return found;
  }
  state head() const override { return head_of(at_); }
  state state_here() const override { return Method::state_of(system_, at_); }
  std::int64_t evaluations(int lane) const override {
    if constexpr (counts_itself) {
      return evaluations_of(at_, lane);
    } else {
      return Method::evaluations_per_step * this->steps();
    }
  }
  void retire(int lane) override { retire_lane(at_, lane); }

  // The loop all the time is spent in. It stops early only where a lane is not finite, and returns the number of steps.
  [[gnu::noinline]] std::int64_t take_steps_of(S h, carried& from, std::int64_t most) const {
    carried at = from;
    std::int64_t n = 0;
    do {
      at = Method::step(system_, S(this->time_after(n)), at, h);
      ++n;
    } while (all_lanes(finite<S>(head_of(at))) && n < most);
    from = at;
    return n;
  }

  Sys system_;
  carried at_;
};

}  // namespace pendula::inline PENDULA_MACHINE
