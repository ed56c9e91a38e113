// Friction that sticks and slips (Filippov 1988; di Bernardo et al. 2008): a motion in pieces, each of them analytic. A
// joint slips forward, slips backward or sticks. A piece ends where the relative velocity of a slipping joint vanishes,
// and where the torque on a stuck one passes what dry friction can hold.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "pendula/method/joints.hpp"
#include "pendula/scalar/compensated.hpp"
#include "pendula/scalar/polynomial_roots.hpp"

namespace pendula::inline PENDULA_MACHINE {

namespace detail {

// Through nine values at equal distances on [0, 1], by Newton's divided differences.
inline polynomial through(std::array<double, 9> value) {
  constexpr int degree = 8;
  for (int order = 1; order <= degree; ++order)
    for (int i = degree; i >= order; --i) value[i] = (value[i] - value[i - 1]) * degree / order;
  polynomial p;
  for (int i = degree; i >= 0; --i) {  // p = p (x − xi) + value
    for (int k = p.degree + 1; k > 0; --k) p.coefficient[k] = p.coefficient[k - 1] - p.coefficient[k] * i / degree;
    p.coefficient[0] = value[i] - p.coefficient[0] * i / degree;
    if (i < degree) ++p.degree;
  }
  return p;
}

// The first place where a polynomial falls through zero; none: 2.
inline double first_fall(const polynomial& p, double noise) {
  double found = 2.0;
  each_crossing(p, 1.0, noise, [&](double x, bool rising) {
    if (!rising) found = std::min(found, x);
  });
  return found;
}

}  // namespace detail

template <class Stepper>
using system_under = std::remove_cvref_t<decltype(std::declval<const Stepper&>().of())>;

// Follows the pieces of one run, step by step; without friction there is nothing to follow. What happens once a piece
// is marked as cold: that saves a sixth of the time to compile the runs.
template <class Stepper>
class piece_follower {};

template <class Stepper>
  requires Piecewise<system_under<Stepper>>
class piece_follower<Stepper> {
 public:
  using S = typename Stepper::S;
  using System = system_under<Stepper>;
  using state = typename Stepper::state;
  static constexpr int joints = System::joints;

  // Whether there is anything to follow.
  static bool follows(const Stepper& stepper) { return std::ranges::any_of(stepper.of().switching(), std::identity{}); }

  // The step that the stepper stands in, at time t: where a joint at rest moves off against its sense, as it does when
  // its acceleration is zero at first, the sense is mended and the step worked out again. True: it was.
  [[gnu::cold]] bool mended(Stepper& stepper, const head_and_tail<S>& t, double direction) {
    bool any = false;
    auto joints_then = stepper.joints();
    for (int j = 0; j < joints; ++j) {
      const double sense = rough(joints_then.senses[j]);
      const bool unsure = rough(joints_then.resting[j]) == 1.0;
      if (!stepper.of().switching()[j] || sense == 0.0 || !unsure) continue;
      if (leaves_along(velocity_polynomial(stepper, j), sense)) continue;
      const bool sticks = rough(stepper.of().holding()[j]) > 0.0;
      joints_then.senses[j] = S(sticks ? 0.0 : -sense);
      any = true;
    }
    if (!any) return false;
    stepper.begin_piece(t.head, stepper.here(), joints_then);
    stepper.expand(t, direction);
    return true;
  }

  // How far after the start of the step, at time t, the piece ends; none: not within it.
  std::optional<S> end_in_step(const Stepper& stepper, const head_and_tail<S>& t) {
    std::optional<S> first;
    for (int j = 0; j < joints; ++j) {
      if (!stepper.of().switching()[j]) continue;
      double leaving = 0.0;
      const bool slips = rough(stepper.of().senses[j]) != 0.0;
      const std::optional<S> found = slips ? turns(stepper, j) : breaks_loose(stepper, t, j, leaving);
      if (!found || (first && !(std::fabs(rough(*found)) < std::fabs(rough(*first))))) continue;
      first = found;
      joint_ = j;
      leaving_ = leaving;
    }
    return first;
  }

  // Goes on with the next piece, from the end of the one before at time t.
  [[gnu::cold]] void begin_next(Stepper& stepper, const head_and_tail<S>& t, const S& tau) {
    auto at = stepper.after(tau);
    const auto before = stepper.joints();
    state y = stepper.state_of(at);
    joints_of<System> now;
    std::array<double, joints> given;
    for (int j = 0; j < joints; ++j) {
      const bool rests = j == joint_ || (stepper.of().switching()[j] && rough(before.senses[j]) == 0.0);
      if (rests) y = stepper.of().with_joint_at_rest(y, j);
      const bool leaves = j == joint_ && leaving_ != 0.0;
      now.resting[j] = S(leaves ? 2.0 : rests ? 1.0 : 0.0);
      given[j] = leaves ? leaving_ : __builtin_nan("");
    }
    now.senses = senses_at(stepper.of(), t, y, given);
    at.head = stepper.head_of(y);
    for (std::size_t i = y.size() / 2; i < y.size(); ++i) at.tail[i] = S(0.0);
    stepper.begin_piece(t.head, at, now);
  }

 private:
  // Whether the joint is at rest at the start of the step.
  static bool rests(const Stepper& stepper, int j) { return rough(stepper.joints().resting[j]) != 0.0; }

  // Of the relative velocity.
  static polynomial velocity_polynomial(const Stepper& stepper, int j) {
    polynomial p = stepper.velocity_polynomial(j);
    if (j > 0) {
      const polynomial below = stepper.velocity_polynomial(j - 1);
      for (int k = 0; k <= p.degree; ++k) p.coefficient[k] -= below.coefficient[k];
    }
    if (rests(stepper, j)) p.coefficient[0] = 0.0;  // not what momenta make of it
    return p;
  }

  static bool leaves_along(const polynomial& p, double sense) {
    // where a joint breaks loose its acceleration is zero, but for rounding
    const double margin = 64.0 * Stepper::precision_inside * p.reach(1.0);
    for (int k = 1; k <= p.degree; ++k)
      if (std::fabs(p.coefficient[k]) > margin) return p.coefficient[k] * sense > 0.0;
    return true;
  }

  // Where the relative velocity of a slipping joint vanishes.
  static std::optional<S> turns(const Stepper& stepper, int j) {
    polynomial p = velocity_polynomial(stepper, j);
    const double sense = rough(stepper.of().senses[j]);
    for (int k = 0; k <= p.degree; ++k) p.coefficient[k] *= sense;
    const double noise = 0x1p-50 * (std::fabs(p.coefficient[0]) + p.reach(1.0));
    const double error = Stepper::precision_inside * p.reach(1.0);
    if (p.coefficient[0] < 0.0) return S(0.0);  // between the last step and this one
    const bool begins = rests(stepper, j);
    double x = 2.0;
    each_crossing(p, 1.0, noise, [&](double at, bool rising) {
      const bool has_moved = !begins || p(0.5 * at) > error;  // else it is an error beside the start
      if (!rising && has_moved) x = std::min(x, at);
    });
    if (x > 1.0) return {};
    const double length = rough(stepper.length());
    return polished(S(x * length), S(p.slope(x) / length * sense), length,
                    [&](const S& tau) { return detail::joint_velocity(stepper.state_of(stepper.after(tau)), j); });
  }

  // Where the torque on a stuck joint passes what holds it, and which way the joint goes from there.
  [[gnu::cold]] static std::optional<S> breaks_loose(const Stepper& stepper, const head_and_tail<S>& t, int j,
                                                     double& leaving) {
    constexpr int parts = 8;  // of the step, each at most a radian of the fastest oscillation: stepper.length()
    const double length = rough(stepper.length());
    const S holding = stepper.of().holding()[j];
    const auto torque = [&](const S& tau) {
      return stepper.of().joints_at(later(t, tau), stepper.state_of(stepper.after(tau))).torques[j];
    };
    for (int part = 0; part < parts; ++part) {
      std::array<double, 9> values;
      for (int i = 0; i < 9; ++i) values[i] = rough(torque(S((part + i / 8.0) / parts * length)));
      for (const double side : {1.0, -1.0}) {
        std::array<double, 9> left;
        for (int i = 0; i < 9; ++i) left[i] = rough(holding) - side * values[i];
        const polynomial p = detail::through(left);
        const double noise = 0x1p-46 * (rough(holding) + p.reach(1.0));
        const bool at_once = p.coefficient[0] <= 0.0 && !leaves_along(p, 1.0);
        const double x = at_once ? 0.0 : detail::first_fall(p, noise);
        if (x > 1.0) continue;
        leaving = side;
        const double slope = -side * p.slope(x) * parts / length;
        return at_once ? S(part * length / parts)
                       : polished(S((part + x) / parts * length), S(slope), length,
                                  [&](const S& tau) { return torque(tau) - S(side) * holding; });
      }
    }
    return {};
  }

  // Newton's method with the slope at hand, as far as it brings a root nearer.
  template <class Value>
  static S polished(S tau, const S& slope, double length, Value&& value) {
    double before = 1e-2 * std::fabs(length);
    for (int i = 0; i < 64; ++i) {
      const S correction = value(tau) / slope;
      const double size = std::fabs(rough(correction));
      if (!(size < before)) break;
      tau = tau - correction;
      before = 0.5 * size;
    }
    return tau;
  }

  int joint_ = 0;         // whose state changes at the end of the piece
  double leaving_ = 0.0;  // which way it goes, where it breaks loose
};

}  // namespace pendula::inline PENDULA_MACHINE
