// The drive of methods that choose their steps and know the motion inside them: outputs and events cost no step.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "pendula/drive/events.hpp"
#include "pendula/drive/outcome.hpp"
#include "pendula/drive/pieces.hpp"
#include "pendula/drive/polling.hpp"
#include "pendula/scalar/compensated.hpp"
#include "pendula/scalar/rough_powers.hpp"

namespace pendula::inline PENDULA_MACHINE {

struct adaptive_result {
  outcome ended = outcome::reached_end;
  std::int64_t steps = 0, evaluations = 0;
  double reached = 0.0;  // the time up to which the motion is known
};

// A run of a stepper of one trajectory, which stands at its start, from t0 to `end`.
template <class Stepper>
class adaptive_run {
 public:
  using S = typename Stepper::S;
  using state = typename Stepper::state;
  using point_in_time = compensated_point<vec<S, 1>>;

  adaptive_run(Stepper& stepper, double t0, double end, std::span<const event> events = {})
      : adaptive_run(stepper, {{S(t0)}, {S(0.0)}}, end, end < t0 ? -1.0 : 1.0) {
    for (const event& each : events) trackers_.emplace_back(each, static_cast<int>(trackers_.size()), t0);
    counts_.resize(trackers_.size());
  }
  // A run that is taken up where a step of another one began.
  adaptive_run(Stepper& stepper, const point_in_time& from, double end, double direction)
      : stepper_(stepper), time_(from), end_(end), direction_(direction) {}

  // Steps to the end. For each step the consumer gets its events, in their order, by event(run, place in the list,
  // tau), and then the step by step(run, stop), while the stepper still stands at its start: the motion is valid up to
  // `stop` after it. step() returns whether to go on, as go_on(time, steps) does, which is called every few
  // milliseconds.
  // It is not inlined, being as long as all the rest of a run: what differs between runs comes before it.
  template <class Consumer, class Poll>
  [[gnu::noinline]] adaptive_result to_end(std::int64_t step_limit, Consumer&& consumer, Poll&& go_on) {
    adaptive_result result;
    for (;;) {
      if (result.steps == step_limit) return ended(result, outcome::step_limit);
      stepper_.expand({time_.head[0], time_.tail[0]}, direction_);
      mend_joints(result.steps == 0, consumer);
      const auto next = stepper_.at_end();
      if (!all_finite(next.head) || !(trackers_.empty() || countable()) || stands_still())
        return ended(result, outcome::not_finite);
      ++result.steps;
      const S left = since_step(end_);
      bool last = rests_for_good() || !(direction_ * rough(stepper_.length()) < direction_ * rough(left));
      S stop = last ? left : S(stepper_.length());
      const bool piece_ends = ends_piece(stop);
      last = last && !piece_ends;
      if constexpr (has_double_precision<S>)
        terminated_ = !trackers_.empty() && report_events(stop, piece_ends, consumer);
      const bool enough = !consumer.step(*this, stop);
      if (terminated_) return ended(result, outcome::event, time_after(stop));
      if (last) return ended(result, outcome::reached_end, end_);
      if (enough) return ended(result, outcome::interrupted, time_after(stop));
      if (piece_ends) {
        begin_piece(stop, consumer);
      } else {
        stepper_.proceed(next);
        time_ = time_.moved_by({S(stepper_.length())});
      }
      if constexpr (requires { consumer.moved(*this); }) consumer.moved(*this);
      if (result.steps % between_polls == 0 && !go_on(rough(time_.head[0]), result.steps))
        return ended(result, outcome::interrupted);
    }
  }

  const Stepper& stepper() const { return stepper_; }
  double direction() const { return direction_; }
  double end() const { return end_; }
  // All numbers that the run goes on from.
  template <class Function>
  void each_number(Function&& change) {
    for (S& x : time_.head) change(x);
    for (S& x : time_.tail) change(x);
    stepper_.each_number(change);
  }
  // Whether one of the events in the step ends the run.
  bool terminated() const { return terminated_; }
  // The start of the step, and how far after it a time is.
  const point_in_time& time() const { return time_; }
  S since_step(double t) const { return (S(t) - time_.head[0]) - time_.tail[0]; }
  double time_after(S tau) const { return rough(time_.moved_by({tau}).head[0]); }

 private:
  using System = std::remove_cvref_t<decltype(std::declval<const Stepper&>().of())>;
  static constexpr std::int64_t between_polls =
      has_double_precision<S> ? adaptive_steps_between_polls : many_digit_steps_between_polls;

  adaptive_result ended(adaptive_result result, outcome how) const { return ended(result, how, rough(time_.head[0])); }
  adaptive_result ended(adaptive_result result, outcome how, double reached) const {
    result.ended = how;
    result.reached = reached;
    result.evaluations = stepper_.evaluations();
    return result;
  }

  static bool all_finite(const state& y) {
    double sum = 0.0;
    for (const S& component : y) sum += rough(component);
    return sum - sum == 0.0;
  }

  bool countable() const {
    if constexpr (has_double_precision<S>)
      for (const event_tracker& each : trackers_)
        if (!each.countable(view_of(stepper_))) return false;
    return true;
  }

  head_and_tail<S> now() const { return {time_.head[0], time_.tail[0]}; }

  // The pieces of a motion with friction.
  template <class Consumer>
  void mend_joints(bool at_start, Consumer& consumer) {
    if constexpr (Piecewise<System>)
      if (pieces_.mended(stepper_, now(), direction_) || (at_start && pieces_.follows(stepper_)))
        report_joints(consumer);
  }
  // Whether dry friction holds it, and nothing will change that.
  bool rests_for_good() const {
    if constexpr (Piecewise<System>) {
      const auto& senses = stepper_.joints().senses;
      return !stepper_.of().driven() && std::ranges::all_of(senses, [](const S& sense) { return rough(sense) == 0.0; });
    } else {
      return false;
    }
  }
  PENDULA_INLINE bool ends_piece(S& stop) {
    if constexpr (Piecewise<System>) {
      return pieces_.follows(stepper_) && finds_end_of_piece(stop);
    } else {
      return false;
    }
  }
  bool finds_end_of_piece(S& stop) {
    if constexpr (Piecewise<System>) {
      const auto found = pieces_.end_in_step(stepper_, now());
      if (!found || direction_ * rough(*found - stop) > 0.0) return false;
      stop = *found;
      return true;
    } else {
      return false;
    }
  }
  template <class Consumer>
  void begin_piece(const S& stop, Consumer& consumer) {
    if constexpr (Piecewise<System>) {
      const double before = rough(time_.head[0]);
      const auto next = time_.moved_by({stop});
      pieces_.begin_next(stepper_, {next.head[0], next.tail[0]}, stop);
      time_ = next;
      pieces_at_once_ = rough(time_.head[0]) == before ? pieces_at_once_ + 1 : 0;
      report_joints(consumer);
    }
  }
  template <class Consumer>
  void report_joints(Consumer& consumer) {
    if constexpr (requires { consumer.piece(*this); }) consumer.piece(*this);
  }
  // Whether the joints change again and again at one time.
  bool stands_still() const { return pieces_at_once_ > 100; }

  // True where one ends the run, at the time `stop` then is. Where a piece ends a velocity is zero but for rounding,
  // which may put that behind the end; and of one that stays at rest nothing comes to light later.
  template <class Consumer>
  bool report_events(S& stop, bool piece_ends, Consumer& consumer) {
    found_.clear();
    const view_of view(stepper_);
    const double last = rough(stop), end = last / stepper_.length();
    for (event_tracker& each : trackers_) each.find(view, piece_ends ? std::min(1.0, end + 0x1p-46) : end, found_);
    for (crossing& each : found_)
      if (std::fabs(each.tau) > std::fabs(last)) each.tau = last;
    sort_as_met(found_, direction_);
    bool terminated = false;
    for (const crossing& each : found_) {
      if (terminated && !at_once(each.tau, rough(stop), stepper_.length())) break;
      const S tau = terminated ? stop : with_changes(view, each);
      consumer.event(*this, each.event, tau);
      if (++counts_[each.event] != trackers_[each.event].what().terminal || terminated) continue;
      stop = tau;
      terminated = true;
    }
    return terminated;
  }

  // The time of a crossing as a number that follows start and parameters, where S does: its derivatives are those of
  // one step of Newton's method. Its value stays, also where the quantity stands still and that step is no number.
  S with_changes(const step_view& view, const crossing& at) const {
    if constexpr (std::same_as<S, double>) {
      return at.tau;
    } else {
      const event& what = trackers_[at.event].what();
      const auto& system = stepper_.of();
      const auto y = stepper_.state_of(stepper_.after(S(at.tau)));
      constexpr std::size_t freedom = degrees_of_freedom<System>;
      const auto i = static_cast<std::size_t>(what.index);
      const S quantity = what.kind == event_kind::angle           ? y[i]
                         : what.kind == event_kind::velocity_zero ? y[freedom + i]
                                                                  : system.positions(y).back()[1];
      S tau = S(at.tau) - (quantity - S(rough(quantity))) / S(trackers_[at.event].rate(view, at.tau));
      tau.value = at.tau;
      return tau;
    }
  }

  Stepper& stepper_;
  point_in_time time_;
  double end_, direction_;
  bool terminated_ = false;
  [[no_unique_address]] piece_follower<Stepper> pieces_;
  int pieces_at_once_ = 0;
  std::vector<event_tracker> trackers_;
  std::vector<std::int64_t> counts_;
  std::vector<crossing> found_;
};

}  // namespace pendula::inline PENDULA_MACHINE
