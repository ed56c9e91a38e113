// Events inside the steps of a run: an angle passes a value, a velocity zero, or the tip a height. The step's
// polynomial is searched for all its crossings, so that none is lost between the ends of the step.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "pendula/scalar/polynomial_roots.hpp"
#include "pendula/scalar/sincos.hpp"
#include "pendula/scalar/wide.hpp"

namespace pendula {

enum class event_kind : std::uint8_t { angle, velocity, tip_height };

struct event {
  event_kind kind;
  int index = 0;             // of the angle or velocity, from 0
  double value = 0.0;        // that is passed,
  double value_tail = 0.0;   // and what it goes on with
  bool every_turn = false;   // an angle passes the value and any number of turns, too
  int direction = 0;         // 1: growing with time, −1: falling, 0: both
  std::int64_t at_most = 0;  // so many end the run; 0: none does
};

namespace detail {

// 2π; head and tail.
inline constexpr double turn_head = 0x1.921fb54442d18p+2, turn_tail = 0x1.1a62633145c07p-52;
// Nearer to zero than this, in parts of what the polynomial changes by, the side of a step's start is not known.
inline constexpr double unsure = 0x1p-44;

// Of an angle that is a polynomial: s' = c θ', c' = −s θ'.
inline polynomial cosine_of(const polynomial& angle) {
  polynomial s, c;
  s.degree = c.degree = std::max(angle.degree, 40);
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

template <class Stepper>
polynomial height_of_tip(const Stepper& stepper) {
  polynomial height;
  const auto lengths = stepper.of().lengths();
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const polynomial cosine = cosine_of(stepper.angle_polynomial(static_cast<int>(i)));
    height.degree = cosine.degree;
    for (int k = 0; k <= cosine.degree; ++k) height.coefficient[k] -= lengths[i] * cosine.coefficient[k];
  }
  return height;
}

}  // namespace detail

struct crossing {
  double tau;  // since the start of the step
  int event;
};

// One event of one run. Target n is the value and n turns (or the value alone, n = 0); the motion is in gap n between
// targets n and n + 1 (or above, or in gap −1 below). The gap it was last in tells whether a crossing next to the end
// of a step has been seen already, or is still to be told.
class event_tracker {
 public:
  event_tracker(const event& what, int place) : what_(what), place_(place) {}

  // Adds the crossings of a step that is worked out, up to the part `end` of its length, in their order.
  template <class Stepper>
  void find(const Stepper& stepper, double end, std::vector<crossing>& found) {
    const polynomial p = quantity(stepper);
    const double reach = p.reach(1.0), margin = detail::unsure * reach;
    const std::int64_t nearest = what_.every_turn ? std::llrint(p.coefficient[0] / detail::turn_head) : 0;
    const double beside = less(stepper, p, nearest).coefficient[0];
    if (first_) {
      gap_ = beside > margin || (beside >= -margin && moves_up(p, margin)) ? nearest : nearest - 1;
    } else if (std::fabs(beside) > margin) {
      pass(stepper, 0.0, beside > 0.0 ? nearest : nearest - 1, found);
    }
    first_ = false;
    if (!what_.every_turn) {
      search(stepper, p, 0, 0, end, found);
    } else {
      const auto turns = [](double angle) { return static_cast<std::int64_t>(angle / detail::turn_head); };
      const double start = p.coefficient[0];
      search(stepper, p, turns(std::floor(start - reach)) - 1, turns(std::ceil(start + reach)) + 1, end, found);
    }
  }

  const event& what() const { return what_; }

 private:
  struct passage {
    double x;
    std::int64_t gap;  // after it
  };

  // What the event is about, less its value, on [0, 1] for the whole step.
  template <class Stepper>
  polynomial quantity(const Stepper& stepper) const {
    polynomial p;
    if (what_.kind == event_kind::angle) p = stepper.angle_polynomial(what_.index);
    if (what_.kind == event_kind::velocity) p = stepper.velocity_polynomial(what_.index);
    if (what_.kind == event_kind::tip_height) p = detail::height_of_tip(stepper);
    p.coefficient[0] -= what_.value;
    return p;
  }

  // The same less n turns, with the tails of angle and value.
  template <class Stepper>
  polynomial less(const Stepper& stepper, polynomial p, std::int64_t n) const {
    if (what_.kind == event_kind::angle) p.coefficient[0] = precisely(stepper, 0.0, n);
    return p;
  }

  // The quantity a time tau into the step, less value and n turns, without the cancellation.
  template <class Stepper>
  double precisely(const Stepper& stepper, double tau, std::int64_t n) const {
    const auto point = stepper.after(tau);
    if (what_.kind == event_kind::angle) {
      const wide<double> turns = wide<double>(detail::turn_head, detail::turn_tail) * static_cast<double>(n);
      const wide<double> angle(two_sum(point.head[what_.index], point.tail[what_.index]));
      return rounded(angle - wide<double>(what_.value, what_.value_tail) - turns);
    }
    const auto y = stepper.state_of(point);
    if (what_.kind == event_kind::velocity) return y[y.size() / 2 + what_.index] - what_.value;
    return stepper.of().positions(y).back()[1] - what_.value;
  }

  // Which way the quantity goes that starts on its target.
  static bool moves_up(const polynomial& p, double margin) {
    for (int k = 1; k <= p.degree; ++k)
      if (std::fabs(p.coefficient[k]) > margin) return p.coefficient[k] > 0.0;
    return true;
  }

  template <class Stepper>
  void search(const Stepper& stepper, const polynomial& p, std::int64_t lowest, std::int64_t highest, double end,
              std::vector<crossing>& found) {
    std::vector<passage> passages;
    for (std::int64_t n = lowest; n <= highest; ++n) {
      const polynomial of_target = less(stepper, p, n);
      each_crossing(of_target, end, [&](double x, bool rising) {
        passages.push_back({polished(stepper, of_target, n, x), rising ? n : n - 1});
      });
    }
    std::sort(passages.begin(), passages.end(), [](const passage& a, const passage& b) { return a.x < b.x; });
    for (const passage& each : passages) pass(stepper, each.x, each.gap, found);
  }

  // The root with what the polynomial does not know: its first coefficients' rounding, and terms left out.
  template <class Stepper>
  double polished(const Stepper& stepper, const polynomial& p, std::int64_t n, double x) const {
    double allowed = 1e-6;
    for (int i = 0; i < 4; ++i) {
      const double correction = precisely(stepper, x * stepper.length(), n) / p.slope(x);
      if (!(std::fabs(correction) < allowed)) break;
      x = std::clamp(x - correction, 0.0, 1.0);
      allowed = 0.5 * std::fabs(correction);
    }
    return x;
  }

  template <class Stepper>
  void pass(const Stepper& stepper, double x, std::int64_t gap, std::vector<crossing>& found) {
    if (gap == gap_) return;
    const bool grows = (gap > gap_) == (stepper.length() > 0.0);  // with time, whichever way the run goes
    gap_ = gap;
    if (what_.direction == 0 || grows == (what_.direction > 0)) found.push_back({x * stepper.length(), place_});
  }

  event what_;
  int place_;
  bool first_ = true;
  std::int64_t gap_ = 0;
};

}  // namespace pendula
