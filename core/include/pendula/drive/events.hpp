// Events inside the steps of a run: an angle passes a value, a velocity zero, or the tip a height. The step's
// polynomial is searched for all its crossings, so that none is lost between the ends of the step.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "pendula/drive/event.hpp"
#include "pendula/drive/step_view.hpp"
#include "pendula/scalar/sincos.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// 2π; head and tail.
inline constexpr double turn_head = 0x1.921fb54442d18p+2, turn_tail = 0x1.1a62633145c07p-52;
// Both in parts of what the quantity changes by in the step. Nearer to a target than this, rounding hides on which side
// of it the quantity is.
inline constexpr double unsure = 0x1p-44;
// Nearer to a target than this at the start of a step, a crossing can lie where two steps join: the step before may
// have ended on the wrong side of it by its own error.
inline constexpr double joining = 0x1p-30;
// More turns than these in one step, about a second's work, or so far away, are not looked at one by one.
inline constexpr double most_turns = 0x1p18, most_turns_of_tip = 0x1p12, farthest_turn = 0x1p50;

inline double last_bit(double t) { return std::nextafter(std::fabs(t), HUGE_VAL) - std::fabs(t); }

// Of an angle that is a polynomial: s' = c θ', c' = −s θ'.
inline polynomial cosine_of(const polynomial& angle) {
  polynomial s, c;
  s.degree = c.degree = std::max(angle.degree, 40);  // the next order is below 2^-160 within 1 rad
  const auto start = sincos(angle.coefficient[0]);
  s.coefficient[0] = start.sin;
  c.coefficient[0] = start.cos;
  for (int k = 0; k < c.degree; ++k) {
    double of_s = 0.0, of_c = 0.0;
    for (int j = 1; j <= std::min(k + 1, angle.degree); ++j) {
      of_s += j * angle.coefficient[j] * c.coefficient[k + 1 - j];
      of_c += j * angle.coefficient[j] * s.coefficient[k + 1 - j];
    }
    s.coefficient[k + 1] = of_s / (k + 1);
    c.coefficient[k + 1] = -of_c / (k + 1);
  }
  return c;
}

}  // namespace detail

struct crossing {
  double tau;  // since the start of the step
  int event;
};

// Whether two crossings of a step are at the same instant: a run that one of them ends and the next run, which starts
// on the targets of both, would lose the other.
inline bool at_once(double tau, double other, double length) {
  return std::fabs(tau - other) <= detail::unsure * std::fabs(length);
}

// In the order in which a run in that direction meets them.
inline void sort_as_met(std::vector<crossing>& found, double direction) {
  std::stable_sort(found.begin(), found.end(),
                   [direction](const crossing& a, const crossing& b) { return a.tau * direction < b.tau * direction; });
}

// One event of one run. Target n is the value and n turns (or the value alone, n = 0); the motion is in gap n between
// targets n and n + 1 (or above, or in gap −1 below). The gap it was last in says whether a crossing next to the end
// of a step has been reported already.
class event_tracker {
 public:
  event_tracker(const event& what, int place, double t0)
      : what_(what), place_(place), last_bits_of_time_(2.0 * detail::last_bit(t0)) {}

  // Whether all crossings of the step can be found; a motion too fast for that ends the run.
  [[gnu::noinline]] bool countable(const step_view& stepper) const {
    const auto few = [&](int angle, double most) {
      const polynomial p = stepper.angle_polynomial(angle);
      return p.reach(1.0) <= most * detail::turn_head &&
             std::fabs(p.coefficient[0]) <= detail::farthest_turn * detail::turn_head;
    };
    if (what_.kind == event_kind::angle) return !what_.every_turn || few(what_.index, detail::most_turns);
    if (what_.kind == event_kind::velocity_zero) return true;
    for (std::size_t i = 0; i < stepper.lengths().size(); ++i)
      if (!few(static_cast<int>(i), detail::most_turns_of_tip)) return false;
    return true;
  }

  // Adds the crossings of a step that is worked out, up to the part `end` of its length, in their order.
  [[gnu::noinline]] void find(const step_view& stepper, double end, std::vector<crossing>& found) {
    const int parts = parts_of(stepper);
    for (int i = 0; i < parts && i < end * parts; ++i) {
      const piece part{static_cast<double>(i) / parts, 1.0 / parts};
      find_in(stepper, part, std::min(1.0, (end - part.from) / part.width), found);
    }
  }

  const event& what() const { return what_; }

  // How fast the quantity changes a time tau into the step.
  [[gnu::noinline]] double rate(const step_view& stepper, double tau) const {
    const int parts = parts_of(stepper);
    const double x = tau / stepper.length();
    const double i = std::min(std::floor(x * parts), parts - 1.0);
    const piece part{i / parts, 1.0 / parts};
    return quantity(stepper, part).slope((x - part.from) / part.width) / (part.width * stepper.length());
  }

 private:
  struct piece {  // of a step
    double from, width;
  };
  struct passage {
    double y;
    std::int64_t gap;  // after it
  };

  // The cosine of an angle is a good polynomial for a turn of 1 rad, not for that of any step.
  int parts_of(const step_view& stepper) const {
    double reach = 1.0;
    if (what_.kind == event_kind::tip_height)
      for (std::size_t i = 0; i < stepper.lengths().size(); ++i)
        reach = std::max(reach, stepper.angle_polynomial(static_cast<int>(i)).reach(1.0));
    return static_cast<int>(std::ceil(reach));
  }

  void find_in(const step_view& stepper, piece part, double end, std::vector<crossing>& found) {
    const polynomial p = quantity(stepper, part);
    const double reach = p.reach(1.0), noise = 0x1p-50 * (size(stepper, p) + reach);
    const double margin = std::max(detail::unsure * reach, noise);
    const double beside = minus_turns(stepper, part, p, nearest(p.coefficient[0])).coefficient[0];
    const bool first = first_;
    const bool sure_of_start =
        first ? begin_run(stepper, part, beside, p, margin) : begin(stepper, part, beside, p, margin, found);
    std::vector<passage> passages;
    const auto turns = [](double angle) { return static_cast<std::int64_t>(angle / detail::turn_head); };
    const std::int64_t lowest = what_.every_turn ? turns(std::floor(p.coefficient[0] - reach)) - 1 : 0;
    const std::int64_t highest = what_.every_turn ? turns(std::ceil(p.coefficient[0] + reach)) + 1 : 0;
    for (std::int64_t n = lowest; n <= highest; ++n) {
      const polynomial of_target = minus_turns(stepper, part, p, n);
      each_crossing(of_target, end, noise, [&](double y, bool rising) {
        passages.push_back({polished(stepper, part, of_target, n, y), rising ? n : n - 1});
      });
    }
    std::sort(passages.begin(), passages.end(), [](const passage& a, const passage& b) { return a.y < b.y; });
    const std::int64_t n = nearest(p(end)), left_in = passages.empty() ? gap_ : passages.back().gap;
    const double at_end = minus_turns(stepper, part, p, n)(end);
    const bool short_of_one = std::fabs(at_end) > margin && left_in != (at_end > 0.0 ? n : n - 1);
    if (short_of_one && !sure_of_start && !first) pass(stepper, part.from, side_after(beside, p, margin), found);
    for (const passage& each : passages) pass(stepper, part.from + part.width * each.y, each.gap, found);
  }

  // Which gap a run begins in; false where it starts on a target. That it does where an event ended the run before it,
  // whose state is on the target but for its rounding, and for what the quantity changes by in the last bits of t0.
  bool begin_run(const step_view& stepper, piece part, double beside, const polynomial& p, double margin) {
    first_ = false;
    const double rate = p.reach(1.0) / (part.width * std::fabs(stepper.length()));
    const double rounding = 0x1p-50 * (size(stepper, p) + scale(stepper)) + rate * last_bits_of_time_;
    const double near = std::max(margin, rounding);
    gap_ = side_after(beside, p, near);
    return std::fabs(beside) > near;
  }

  // What the numbers of a state are as large as that the quantity is made of: their rounding is in parts of that.
  double scale(const step_view& stepper) const {
    if (what_.kind == event_kind::angle) return stepper.amplitude();
    double sum = 0.0;
    if (what_.kind == event_kind::velocity_zero) {
      sum = stepper.amplitude() * stepper.frequency();
      for (int i = 0; i < stepper.angles(); ++i) sum += std::fabs(stepper.velocity_polynomial(i).coefficient[0]);
    } else {
      const auto lengths = stepper.lengths();
      for (std::size_t i = 0; i < lengths.size(); ++i)
        sum += lengths[i] * std::fabs(stepper.angle_polynomial(static_cast<int>(i)).coefficient[0]);
    }
    return sum;
  }

  // Which gap the motion is in at the start of a part; false where it is too near to a target to decide. Where it is
  // not the gap it was left in, a crossing lies where the parts join.
  bool begin(const step_view& stepper, piece part, double beside, const polynomial& p, double margin,
             std::vector<crossing>& found) {
    const bool sure = std::fabs(beside) > margin;
    const std::int64_t now = side_after(beside, p, margin);
    if (sure && std::fabs(beside) <= detail::joining * p.reach(1.0)) pass(stepper, part.from, now, found);
    if (sure) gap_ = now;
    return sure;
  }

  // The gap at the start, or just after it where that is on a target.
  std::int64_t side_after(double beside, const polynomial& p, double margin) const {
    const std::int64_t n = nearest(p.coefficient[0]);
    return beside > margin || (beside >= -margin && moves_up(p, margin)) ? n : n - 1;
  }

  std::int64_t nearest(double quantity) const {
    return what_.every_turn ? std::llrint(quantity / detail::turn_head) : 0;
  }

  // What the numbers are made of that the quantity is the difference of: its rounding is in parts of that.
  double size(const step_view& stepper, const polynomial& p) const {
    double sum = std::fabs(p.coefficient[0]) + 2.0 * std::fabs(what_.value);
    if (what_.kind == event_kind::tip_height)
      for (double length : stepper.lengths()) sum += length;
    return sum;
  }

  // What the event is about, less its value, on [0, 1] for the part of the step.
  polynomial quantity(const step_view& stepper, piece part) const {
    polynomial p;
    if (what_.kind == event_kind::angle) p = stepper.angle_polynomial(what_.index);
    if (what_.kind == event_kind::velocity_zero) p = stepper.velocity_polynomial(what_.index);
    if (what_.kind == event_kind::tip_height) {
      const auto lengths = stepper.lengths();
      for (std::size_t i = 0; i < lengths.size(); ++i) {
        const polynomial angle = stepper.angle_polynomial(static_cast<int>(i)).about(part.from, part.width);
        const polynomial cosine = detail::cosine_of(angle);
        p.degree = cosine.degree;
        for (int k = 0; k <= cosine.degree; ++k) p.coefficient[k] -= lengths[i] * cosine.coefficient[k];
      }
    }
    p.coefficient[0] -= what_.value;
    return p;
  }

  // The same less n turns, with the tails of angle and value.
  polynomial minus_turns(const step_view& stepper, piece part, polynomial p, std::int64_t n) const {
    if (what_.kind == event_kind::angle) p.coefficient[0] = precisely(stepper, part.from * stepper.length(), n);
    return p;
  }

  // The quantity a time tau into the step, less value and n turns, without the cancellation.
  double precisely(const step_view& stepper, double tau, std::int64_t n) const {
    if (what_.kind == event_kind::velocity_zero) return stepper.velocity(tau, what_.index) - what_.value;
    if (what_.kind == event_kind::tip_height) return stepper.tip_height(tau) - what_.value;
    const auto [head, tail] = stepper.angle(tau, what_.index);
    const wide<double> turns = wide<double>(detail::turn_head, detail::turn_tail) * static_cast<double>(n);
    // the target first: that of −π is then exactly the opposite of that of π
    return rounded(wide<double>(two_sum(head, tail)) - (wide<double>(what_.value, what_.value_tail) + turns));
  }

  // Which way the quantity goes that starts on its target.
  static bool moves_up(const polynomial& p, double margin) {
    for (int k = 1; k <= p.degree; ++k)
      if (std::fabs(p.coefficient[k]) > margin) return p.coefficient[k] > 0.0;
    return true;
  }

  // The root with what the polynomial does not know: its first coefficients' rounding, and terms left out, which a
  // loose tolerance makes large. Where that does not converge, as in a touch, the polynomial's own stands.
  double polished(const step_view& stepper, piece part, const polynomial& p, std::int64_t n, double root) const {
    double y = root, allowed = 1e-2;
    for (int i = 0; i < 8 && allowed > 0x1p-53; ++i) {
      const double correction = precisely(stepper, (part.from + part.width * y) * stepper.length(), n) / p.slope(y);
      if (!(std::fabs(correction) < allowed)) return i > 1 ? y : root;
      y = std::clamp(y - correction, 0.0, 1.0);
      allowed = 0.5 * std::fabs(correction);
    }
    return y;
  }

  void pass(const step_view& stepper, double x, std::int64_t gap, std::vector<crossing>& found) {
    if (gap == gap_) return;
    const bool grows = (gap > gap_) == (stepper.length() > 0.0);  // with time, whichever way the run goes
    gap_ = gap;
    if (what_.direction == 0 || grows == (what_.direction > 0)) found.push_back({x * stepper.length(), place_});
  }

  event what_;
  int place_;
  double last_bits_of_time_;  // two of t0's
  bool first_ = true;
  std::int64_t gap_ = 0;
};

}  // namespace pendula::inline PENDULA_MACHINE
