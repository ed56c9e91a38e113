// Many trajectories through the lanes of one stepper, each with its own time and step; a lane whose trajectory has
// ended takes the next one. The result of a trajectory does not depend on its neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "pendula/drive/events.hpp"
#include "pendula/drive/outcome.hpp"
#include "pendula/drive/polling.hpp"
#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/compensated.hpp"

namespace pendula::inline PENDULA_MACHINE {

// What all the trajectories have in common. Output times, monotonic, in (t0, end].
struct lanes_task {
  double t0, end;
  std::int64_t step_limit;
  std::span<const double> times;
  std::span<const event> events;
};

struct lane_end {
  std::size_t trajectory;
  outcome ended;
  std::int64_t steps, evaluations;
  double reached;  // the time up to which the motion is known
};

inline constexpr std::size_t no_trajectory = static_cast<std::size_t>(-1);

// One lane of a stepper over lanes, as a stepper of one trajectory, for those who look inside its step.
template <class Stepper, class System>
struct lane_view {
  using S = typename Stepper::S;
  static constexpr std::size_t dimension = System::dimension;

  const Stepper& all;
  const System& system;
  int l;

  double length() const { return lane(all.length(), l); }
  polynomial angle_polynomial(int i) const { return all.angle_polynomial(i, l); }
  polynomial velocity_polynomial(int i) const { return all.velocity_polynomial(i, l); }
  double amplitude() const { return all.amplitude(l); }
  double frequency() const { return all.frequency(l); }
  compensated_point<vec<double, dimension>> after(double tau) const {
    const auto point = all.after(S(tau));
    compensated_point<vec<double, dimension>> mine;
    for (std::size_t i = 0; i < dimension; ++i) {
      mine.head[i] = lane(point.head[i], l);
      mine.tail[i] = lane(point.tail[i], l);
    }
    return mine;
  }
  auto state_of(const compensated_point<vec<double, dimension>>& there) const {
    return system.from_canonical(there.head);
  }
  const System& of() const { return system; }
};

// Events in lanes need a stepper that bounds its quantities within a step.
template <class Stepper>
inline constexpr bool finds_events_in_lanes = requires(const Stepper& stepper) { stepper.angle_reach(0); };

// `Stepper` over lanes, `One` the same over plain numbers, through which a trajectory comes in. The feed gives and
// takes:
//     next(one)                            places a trajectory in the stepper and returns its number, or no_trajectory
//     output(trajectory, place, state)     at a time of the task's
//     event(trajectory, place, t, state)   an event of the task's
//     finish(lane_end)                     how it ended
//     go_on()                              asked now and then; false ends all
template <class Stepper, class One, class Feed>
class lanes_run {
 public:
  using S = typename Stepper::S;
  static constexpr int width = lanes<S>::count;
  lanes_run(Stepper& stepper, One& one, const lanes_task& task, Feed& feed)
      : stepper_(stepper), one_(one), task_(task), feed_(feed), direction_(task.end < task.t0 ? -1.0 : 1.0) {}

  void all() {
    for (int l = 0; l < width; ++l) load(l);
    while (running_ > 0) {
      stepper_.expand({time_.head[0], time_.tail[0]}, direction_);
      const S h = stepper_.length(), left = since_step(S(task_.end));
      const auto arrived = mask_not(less(S(direction_) * h, S(direction_) * left));
      const auto next = stepper_.at_end();
      auto sound = finite<S>(next.head);
      ++steps_;
      S stop = choose(arrived, left, h);
      bool terminated = false;
      if constexpr (finds_events_in_lanes<Stepper>) terminated = !task_.events.empty() && report_events(sound, stop);
      if (!task_.times.empty()) report_outputs(sound, stop);
      const auto stopped = time_.moved_by({choose(sound, stop, S(0.0))}).head[0];
      stepper_.proceed(next);
      time_ = time_.moved_by({h});
      if (any_lane(arrived) || !all_lanes(sound) || terminated || steps_ >= soonest_limit_)
        change(arrived, sound, stopped);
      if (steps_ % lane_steps_between_polls == 0 && !feed_.go_on()) return interrupt();
    }
  }

 private:
  using System = std::remove_cvref_t<decltype(std::declval<One>().of())>;
  using view = lane_view<Stepper, System>;

  struct one_lane {
    std::size_t trajectory = no_trajectory, next_output = 0;
    std::int64_t begun = 0, evaluations_before = 0;  // counts of all lanes when it came in
    bool terminated = false;
    System system{};
    std::vector<event_tracker> trackers;
    std::vector<std::int64_t> counts;
  };

  void load(int l) {
    one_lane& mine = lanes_[l];
    mine.trajectory = feed_.next(one_);
    stepper_.take(l, one_);  // an empty lane keeps stepping; its results are discarded
    set_lane(time_.head[0], l, task_.t0);
    set_lane(time_.tail[0], l, 0.0);
    mine.next_output = mine.trajectory == no_trajectory ? task_.times.size() : 0;
    wait_for_output(l);
    if (mine.trajectory == no_trajectory) return;
    mine.begun = steps_;
    mine.evaluations_before = stepper_.evaluations(l) - one_.evaluations();
    mine.terminated = false;
    mine.system = one_.of();
    mine.trackers.clear();
    for (const event& each : task_.events)
      mine.trackers.emplace_back(each, static_cast<int>(mine.trackers.size()), task_.t0);
    mine.counts.assign(task_.events.size(), 0);
    ++running_;
    soonest_limit_ = std::min(soonest_limit_, steps_ + task_.step_limit);
  }

  S since_step(S t) const { return (t - time_.head[0]) - time_.tail[0]; }

  void wait_for_output(int l) {
    const std::size_t next = lanes_[l].next_output;
    set_lane(due_, l,
             next < task_.times.size() ? task_.times[next] : direction_ * std::numeric_limits<double>::infinity());
  }

  // The outputs up to `stop` in the step of each lane.
  template <class Mask>
  void report_outputs(Mask sound, S stop) {
    for (bool any = true; any;) {
      const S tau = since_step(due_);
      const auto hit = mask_and(sound, mask_not(less(stop * S(direction_), tau * S(direction_))));
      if (!any_lane(hit)) return;
      const auto y = stepper_.state_of(stepper_.after(choose(hit, tau, S(0.0))));
      any = false;
      for (int l = 0; l < width; ++l) {
        one_lane& mine = lanes_[l];
        if (!lane_of(hit, l) || mine.next_output == task_.times.size()) continue;
        feed_.output(mine.trajectory, mine.next_output++, state_of_lane(y, l));
        wait_for_output(l);
        any = true;
      }
    }
  }

  // Whether one of the events ends a trajectory, at the time its `stop` then is. One whose events cannot be counted is
  // not sound.
  template <class Mask>
  bool report_events(Mask& sound, S& stop) {
    bool terminated = false;
    for (std::size_t i = 0; i < task_.events.size(); ++i) {
      const auto near = mask_and(sound, can_cross(task_.events[i]));
      if (!any_lane(near)) continue;
      for (int l = 0; l < width; ++l) {
        one_lane& mine = lanes_[l];
        if (!lane_of(near, l) || mine.trajectory == no_trajectory) continue;
        const view of_lane{stepper_, mine.system, l};
        const view_of step(of_lane);
        if (!mine.trackers[i].countable(step)) {
          S this_one(0.0);
          set_lane(this_one, l, 1.0);
          sound = mask_and(sound, equal(this_one, S(0.0)));
          found_[l].clear();
        }
        if (lane_of(sound, l)) mine.trackers[i].find(step, lane(stop, l) / step.length(), found_[l]);
      }
    }
    for (int l = 0; l < width; ++l)
      if (!found_[l].empty() && report_found(l, stop)) terminated = true;
    return terminated;
  }

  bool report_found(int l, S& stop) {
    one_lane& mine = lanes_[l];
    const view step{stepper_, mine.system, l};
    sort_as_met(found_[l], direction_);
    for (const crossing& each : found_[l]) {
      if (mine.terminated && !at_once(each.tau, lane(stop, l), step.length())) break;
      const double tau = mine.terminated ? lane(stop, l) : each.tau;
      const double t = two_sum(lane(time_.head[0], l), tau + lane(time_.tail[0], l)).head;
      feed_.event(mine.trajectory, each.event, t, step.state_of(step.after(tau)));
      if (++mine.counts[each.event] != task_.events[each.event].terminal || mine.terminated) continue;
      set_lane(stop, l, each.tau);
      mine.terminated = true;
    }
    found_[l].clear();
    return mine.terminated;
  }

  // Where the event's quantity can reach its target in this step. A tracker need not look at the other steps: in them
  // the motion stays in the gap it was in.
  auto can_cross(const event& what) const {
    const auto everywhere = equal(S(0.0), S(0.0));
    if (what.kind == event_kind::tip_height) return everywhere;
    const bool of_angle = what.kind == event_kind::angle;
    const S start = of_angle ? stepper_.angle(what.index) : stepper_.velocity(what.index);
    const S reach = of_angle ? stepper_.angle_reach(what.index) : stepper_.velocity_reach(what.index);
    S away = start - S(what.value);
    if (what.every_turn) away = away - nearest_whole(away * S(1.0 / detail::turn_head)) * S(detail::turn_head);
    const S margin = S(0x1p-30) * (reach + magnitude(start) + S(std::fabs(what.value)));
    return mask_not(less(reach + margin, magnitude(away)));
  }

  // Trajectories that have ended make room for the next.
  template <class Mask>
  void change(Mask arrived, Mask sound, S stopped) {
    soonest_limit_ = std::numeric_limits<std::int64_t>::max();
    for (int l = 0; l < width; ++l) {
      one_lane& mine = lanes_[l];
      if (mine.trajectory == no_trajectory) continue;
      std::int64_t taken = steps_ - mine.begun;
      outcome how = outcome::step_limit;
      double reached = lane(stopped, l);
      if (!lane_of(sound, l)) {
        how = outcome::not_finite;
        --taken;
      } else if (mine.terminated) {
        how = outcome::event;
      } else if (lane_of(arrived, l)) {
        how = outcome::reached_end;
        reached = task_.end;
      } else if (taken < task_.step_limit) {
        soonest_limit_ = std::min(soonest_limit_, mine.begun + task_.step_limit);
        continue;
      }
      --running_;
      feed_.finish({mine.trajectory, how, taken, evaluations_of(l), reached});
      load(l);
    }
  }

  void interrupt() {
    for (int l = 0; l < width; ++l)
      if (const one_lane& mine = lanes_[l]; mine.trajectory != no_trajectory)
        feed_.finish(
            {mine.trajectory, outcome::interrupted, steps_ - mine.begun, evaluations_of(l), lane(time_.head[0], l)});
  }

  std::int64_t evaluations_of(int l) const { return stepper_.evaluations(l) - lanes_[l].evaluations_before; }

  static auto state_of_lane(const typename Stepper::state& y, int l) {
    typename One::state mine;
    for (std::size_t i = 0; i < mine.size(); ++i) mine[i] = lane(y[i], l);
    return mine;
  }

  Stepper& stepper_;
  One& one_;
  const lanes_task& task_;
  Feed& feed_;
  double direction_;
  std::int64_t steps_ = 0, soonest_limit_ = std::numeric_limits<std::int64_t>::max();
  int running_ = 0;
  compensated_point<vec<S, 1>> time_;
  S due_;  // the next output
  std::array<one_lane, width> lanes_;
  std::array<std::vector<crossing>, width> found_;
};

}  // namespace pendula::inline PENDULA_MACHINE
