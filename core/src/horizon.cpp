#include "pendula/kernels/horizon.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

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
class grid_checker {
 public:
  grid_checker(const request& asked, detector& beside, const poll& go_on)
      : asked_(asked), beside_(beside), ask_(go_on), last_(place_on_grid(asked.end(), asked.t0, asked.signed_step())) {}

  std::optional<double> horizon() {
    const auto walk = kernel_for(asked_).walk(asked_);
    bool right = true;
    for (std::int64_t n = 1; right && n <= last_.steps; ++n) {
      walk->go_to(n);
      right = right_at(n, *walk, 0.0);
      if (right && n % certified_steps_between_polls == 0 && !ask_(rounded(time_))) return std::nullopt;
    }
    if (right && last_.rest != 0.0) right = right_at(last_.steps + 1, *walk, last_.rest);
    if (beside_.stopped()) return std::nullopt;
    return right ? never : rounded(time_);
  }

 private:
  bool right_at(std::int64_t n, const grid_walk& walk, double rest) {
    walk.state(rest, state_.data());
    const wide<double> on_grid =
        wide<double>(two_product(static_cast<double>(n), asked_.signed_step())) + wide<double>(asked_.t0);
    time_ = n > last_.steps ? wide<double>(asked_.end()) : on_grid;
    const std::span angles(state_.data(), state_.size() / 2);
    return in_range(angles) && beside_.right(time_, angles);
  }

  // Finite angles, which have a sine where there is one in the equations: without it neither the run nor the shadow
  // goes on, and both would spend millions of turns to find that out.
  bool in_range(std::span<const double> angles) const {
    const double range = system_named(asked_.system.name)->can.periodic ? largest_angle : never;
    return std::ranges::all_of(angles, [=](double angle) { return std::fabs(angle) < range; });
  }

  const request& asked_;
  detector& beside_;
  const poll& ask_;
  fixed_output last_;
  std::vector<double> state_ = asked_.state;
  wide<double> time_{};
};

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
  const auto found =
      asked.options.step ? grid_checker(made, diverging, go_on).horizon() : of_adaptive(made, diverging, go_on);
  return found && std::isinf(*found) ? beyond : found;
}

}  // namespace pendula
