// Many trajectories through the lanes of one stepper, each with its own time and step; a lane that has come to its end
// takes the next trajectory. What comes out of one does not depend on its neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "pendula/drive/outcome.hpp"
#include "pendula/scalar/choose.hpp"
#include "pendula/scalar/compensated.hpp"

namespace pendula {

struct lane_end {
  std::size_t trajectory;
  outcome ended;
  std::int64_t steps;
};

// `Stepper` over lanes, `One` the same over plain numbers, through which a trajectory comes in.
template <class Stepper, class One>
class lanes_run {
 public:
  using S = typename Stepper::S;
  static constexpr int width = lanes<S>::count;

  lanes_run(Stepper& stepper, One& one, double t0, double end, std::int64_t step_limit)
      : stepper_(stepper), one_(one), t0_(t0), end_(end), direction_(end < t0 ? -1.0 : 1.0), step_limit_(step_limit) {}

  // Runs trajectories 0 … count − 1 to the end. start(n, one) places one of them in the stepper of plain numbers;
  // finish(lane_end, state) is told of each as it ends.
  template <class Start, class Finish>
  void all(std::size_t count, Start&& start, Finish&& finish) {
    count_ = count;
    for (int l = 0; l < width; ++l) load(l, start);
    while (running_ > 0) {
      stepper_.expand(direction_);
      const S h = stepper_.length(), left = (S(end_) - time_.head[0]) - time_.tail[0];
      const auto arrived = opposite(less(S(direction_) * h, S(direction_) * left));
      const auto next = stepper_.after(h);
      const auto well = finite<S>(next.head);
      ++steps_;
      if (!any_lane(arrived) && all_lanes(well) && steps_ < soonest_limit_) {
        proceed(next, h);
        continue;
      }
      const auto y = stepper_.state_of(stepper_.after(choose(arrived, left, S(0.0))));
      proceed(next, h);
      for (int l = 0; l < width; ++l) {
        if (lane_end end = end_of(l, lane_of(arrived, l), lane_of(well, l)); end.trajectory != none) {
          finish(end, state_of_lane(y, l));
          load(l, start);
        }
      }
    }
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  template <class Start>
  void load(int l, Start& start) {
    if (next_ == count_) {
      ids_[l] = none;  // what the lane goes on with is told nobody
      stepper_.take(l, one_);
      return;
    }
    start(next_, one_);
    stepper_.take(l, one_);
    set_lane(time_.head[0], l, t0_);
    set_lane(time_.tail[0], l, 0.0);
    ids_[l] = next_++;
    begun_[l] = steps_;
    ++running_;
    soonest_limit_ = std::min(soonest_limit_, steps_ + step_limit_);
  }

  // How a lane's trajectory has ended, or none if it has not.
  lane_end end_of(int l, bool arrived, bool well) {
    const std::int64_t taken = steps_ - begun_[l];
    const bool goes_on = well && !arrived && taken < step_limit_;
    if (goes_on || ids_[l] == none) return {none, outcome::reached_end, 0};
    --running_;
    return {ids_[l], well ? (arrived ? outcome::reached_end : outcome::step_limit) : outcome::not_finite, taken};
  }

  static auto state_of_lane(const typename Stepper::state& y, int l) {
    typename One::state mine;
    for (std::size_t i = 0; i < mine.size(); ++i) mine[i] = lane(y[i], l);
    return mine;
  }

  void proceed(const typename Stepper::point& next, S h) {
    stepper_.proceed(next);
    time_ = time_.moved_by({h});
  }

  Stepper& stepper_;
  One& one_;
  double t0_, end_, direction_;
  std::int64_t step_limit_, steps_ = 0, soonest_limit_ = std::numeric_limits<std::int64_t>::max();
  std::size_t count_ = 0, next_ = 0;
  int running_ = 0;
  compensated_point<vec<S, 1>> time_;
  std::array<std::size_t, width> ids_;
  std::array<std::int64_t, width> begun_;
};

}  // namespace pendula
