// How long a run with doubles is right: the time at which an angle first is off by more than a tolerance, found beside
// a shadow, the same motion by the Taylor method with twice the digits. The shadow need not be right for longer than
// the run is: chaos makes the errors of both grow by the same factor, and where it has carried the run's, 2^-53 or more
// at the start, to a radian, it has carried the shadow's, 2^-104, to 2^-51 of a radian.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "pendula/drive/polling.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

// `Shadow` stands in a step of its own: proceed() to the next, step_end() as head and tail, and angles(time, to). There
// are so many `angles`.
template <class Shadow>
class divergence_detector {
 public:
  using poll = std::function<bool(double)>;

  // `go_on` is asked with the time now and then; once it says false, nothing is right, and the detector `stopped`.
  divergence_detector(Shadow& beside, std::size_t angles, double tolerance, double direction, const poll& go_on)
      : beside_(beside), angles_(angles), own_(angles), tolerance_(tolerance), direction_(direction), go_on_(go_on) {}

  bool stopped() const { return stopped_; }

  // Of angles that follow one another in time: whether these are still right.
  template <class Angles>
  bool right(wide<double> time, const Angles& y) {
    while (ahead(time) > 0.0)
      if (!proceed()) return false;
    return close(time, y);
  }

  // For a step of a run that knows the motion inside it, from the step's start, where it still is right, up to its
  // stop: how far it is right. Its angles and the shadow's are compared at several times on each piece where both are
  // polynomials.
  template <class Step>
  double right_in_step(const Step& step) {
    const auto [head, tail] = step.start();
    const wide<double> start(head, tail);
    const double stop = step.stop();
    const auto is_right = [&](double tau) {
      step.angles(tau, own_.data());
      return close(start + wide<double>(tau), own_);
    };
    for (double from = 0.0;;) {
      const double reach = -ahead_of(start), end = direction_ * std::min(direction_ * reach, direction_ * stop);
      for (int i = 1; i <= looks; ++i) {
        const double tau = i == looks ? end : from + (end - from) * i / looks;
        if (!is_right(tau)) return last_right(from + (end - from) * (i - 1) / looks, tau, is_right);
      }
      if (end == stop) return stop;
      if (!proceed()) return end;
      from = end;
    }
  }

 private:
  static constexpr int looks = 8, halvings = 40;

  // False where the shadow is at its own limit, at speeds that leave no time between two of its steps, or is not to go
  // on.
  bool proceed() {
    const auto before = beside_.step_end();
    beside_.proceed();
    const auto after = beside_.step_end();
    if (++steps_ % shadow_steps_between_polls == 0 && !go_on_(after.head)) stopped_ = true;
    return !stopped_ && (after.head != before.head || after.tail != before.tail);
  }

  // How far a time is beyond the end of the shadow's step.
  double ahead_of(wide<double> time) const {
    const auto [head, tail] = beside_.step_end();
    return rounded(time - wide<double>(head, tail));
  }
  double ahead(wide<double> time) const { return direction_ * ahead_of(time); }

  template <class Angles>
  bool close(wide<double> time, const Angles& y) const {
    beside_.angles({time.hi, time.lo}, angles_.data());
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      const double apart = std::fabs((y[i] - angles_[i].head) - angles_[i].tail);
      if (!(apart <= tolerance_)) return false;
    }
    return true;
  }

  template <class Right>
  static double last_right(double right, double wrong, Right&& is_right) {
    for (int i = 0; i < halvings; ++i) {
      const double middle = 0.5 * (right + wrong);
      (is_right(middle) ? right : wrong) = middle;
    }
    return right;
  }

  Shadow& beside_;
  mutable std::vector<decltype(std::declval<Shadow&>().step_end())> angles_;  // the shadow's
  std::vector<double> own_;                                                   // the run's
  double tolerance_, direction_;
  const poll& go_on_;
  long steps_ = 0;
  bool stopped_ = false;
};

}  // namespace pendula::inline PENDULA_MACHINE
