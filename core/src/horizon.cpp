#include "pendula/kernels/horizon.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "pendula/drive/divergence.hpp"
#include "pendula/drive/fixed_grid.hpp"
#include "pendula/drive/polling.hpp"
#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/run_kernels.hpp"
#include "pendula/kernels/shadow_kernels.hpp"
#include "pendula/scalar/sincos.hpp"

namespace pendula {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

using detector = divergence_detector<shadow>;
using poll = detector::poll;

// Inside the steps of a run that knows the motion there.
struct step_checker final : receiver {
  step_checker(detector& beside, const poll& go_on) : beside(beside), ask(go_on) {}

  bool output(std::size_t, double, const double*) override { return true; }
  void event(int, double, const double*) override {}
  bool step(const step_motion& motion) override {
    const double right = beside.right_in_step(motion);
    if (right != motion.stop()) horizon = motion.time_after(right);
    return right == motion.stop();
  }
  bool go_on(double t) override { return going_on = ask(t); }

  detector& beside;
  const poll& ask;
  double horizon = never;
  bool going_on = true;
};

std::optional<double> of_adaptive(const request& asked, detector& beside, const poll& go_on) {
  step_checker checking(beside, go_on);
  const run_end end = kernel_for(asked).solve(asked, checking);
  if (!checking.going_on || beside.stopped()) return std::nullopt;
  return end.ended == outcome::not_finite ? end.reached : checking.horizon;
}

// Steps where the run has them, at t0 + n h, and the shortened one at the end.
struct grid_checker final : receiver {
  grid_checker(const request& asked, detector& beside, const poll& go_on)
      : asked(asked), beside(beside), ask(go_on), last(place_on_grid(asked.end(), asked.t0, asked.signed_step())) {}

  bool output(std::size_t place, double, const double* y) override {
    const auto n = static_cast<std::int64_t>(place);
    const wide<double> on_grid =
        wide<double>(two_product(static_cast<double>(n), asked.signed_step())) + wide<double>(asked.t0);
    const wide<double> time = n > last.steps ? wide<double>(asked.end()) : on_grid;
    const std::span angles(y, asked.state.size() / 2);
    const bool right = in_range(angles) && beside.right(time, angles);
    if (!right) horizon = rounded(time);
    if (n % certified_steps_between_polls == 0) going_on = ask(rounded(time));
    return right && going_on;
  }
  void event(int, double, const double*) override {}
  bool step(const step_motion&) override { return true; }
  bool go_on(double) override { return true; }

  // Finite angles, which have a sine where there is one in the equations: without it neither the run nor the shadow
  // goes on, and both would spend millions of turns to find that out.
  bool in_range(std::span<const double> angles) const {
    const double range = system_named(asked.system.name)->can.periodic ? largest_angle : never;
    return std::ranges::all_of(angles, [=](double angle) { return std::fabs(angle) < range; });
  }

  const request& asked;
  detector& beside;
  const poll& ask;
  fixed_output last;
  double horizon = never;
  bool going_on = true;
};

std::optional<double> of_fixed(const request& asked, detector& beside, const poll& go_on) {
  grid_checker checking(asked, beside, go_on);
  kernel_for(asked).each_step(asked, checking);
  if (beside.stopped() || (!checking.going_on && checking.horizon == never)) return std::nullopt;
  return checking.horizon;
}

// Asks some times a second, however often it is asked itself.
poll throttled(const watcher& watch, double t0, double span) {
  using clock = std::chrono::steady_clock;
  return [&watch, t0, span, last = clock::now()](double t) mutable {
    const auto now = clock::now();
    if (now - last < between_looks) return true;
    last = now;
    return watch((t - t0) / span);
  };
}

}  // namespace

std::optional<double> trust_horizon(const request& asked, double reached, outcome ended, const watcher& watch) {
  const double beyond = ended == outcome::not_finite ? reached : never;
  if (reached == asked.t0) return beyond;
  request made = asked;  // as far as it came
  made.times = {reached};
  made.own_steps = false;
  made.events.clear();
  made.options.max_steps.reset();
  const auto beside = best_shadow_maker().make(made);
  const poll go_on = throttled(watch, asked.t0, reached - asked.t0);
  detector diverging(*beside, asked.state.size() / 2, *asked.options.certify, made.direction(), go_on);
  const auto found = asked.options.step ? of_fixed(made, diverging, go_on) : of_adaptive(made, diverging, go_on);
  return found && std::isinf(*found) ? beyond : found;
}

}  // namespace pendula
