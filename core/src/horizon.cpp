#include "pendula/kernels/horizon.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/drive/divergence.hpp"
#include "pendula/drive/fixed_grid.hpp"
#include "pendula/kernels/catalogue.hpp"
#include "pendula/kernels/run_kernels.hpp"
#include "pendula/kernels/shadow_kernels.hpp"

namespace pendula {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

using detector = divergence_detector<shadow>;
using poll = detector::poll;

struct step_checker {
  detector& beside;
  double horizon = never;

  template <class Run>
  void event(const Run&, int, double) {}
  template <class Run>
  bool step(const Run& run, double stop) {
    const double right = beside.right_in_step(run, stop);
    if (right != stop) horizon = run.time_after(right);
    return right == stop;
  }
};

template <class Stepper>
std::optional<double> of_adaptive(Stepper& stepper, const request& asked, detector& beside, const poll& go_on) {
  adaptive_run<Stepper> run(stepper, asked.t0, asked.end());
  step_checker checking{beside};
  bool going_on = true;
  const auto ended = run.to_end(std::numeric_limits<std::int64_t>::max(), checking,
                                [&](double t, std::int64_t) { return going_on = go_on(t); });
  if (!going_on || beside.stopped()) return std::nullopt;
  return ended.ended == outcome::not_finite ? run.time_after(0.0) : checking.horizon;
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
    const std::span state(y, asked.state.size());
    const bool right = in_range(state) && beside.right(time, state);
    if (!right) horizon = rounded(time);
    if (n % certified_steps_between_polls == 0) going_on = ask(rounded(time));
    return right && going_on;
  }
  void event(int, double, const double*) override {}
  void step(const step_memory&) override {}
  bool go_on(double) override { return true; }

  // Finite angles, which have a sine where there is one in the equations: without it neither the run nor the shadow
  // goes on, and both would spend millions of turns to find that out.
  bool in_range(std::span<const double> state) const {
    const double range = system_named(asked.system.name)->can.periodic ? largest_angle : never;
    return std::ranges::all_of(state.first(state.size() / 2), [=](double angle) { return std::fabs(angle) < range; });
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

std::optional<double> of_method_with_dense_output(const request& asked, detector& beside, const poll& go_on) {
  std::optional<double> found;
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    typename Sys::state start;
    std::copy_n(asked.state.begin(), start.size(), start.begin());
    with<adaptive_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) {
        typename Method::template stepper<Sys> stepper(
            Entry::template make<double>(asked.system.form, asked.system.parameters.data()),
            log2_of_tolerance(asked.options));
        stepper.start(asked.t0, start);
        found = of_adaptive(stepper, asked, beside, go_on);
      }
    });
  });
  return found;
}

// Asks some ten times a second, however often it is asked itself.
poll throttled(const watcher& watch, double t0, double span) {
  using clock = std::chrono::steady_clock;
  return [&watch, t0, span, last = clock::now()](double t) mutable {
    const auto now = clock::now();
    if (now - last < std::chrono::milliseconds(100)) return true;
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
  const auto beside = best_shadow_maker().make(made);
  const poll go_on = throttled(watch, asked.t0, reached - asked.t0);
  detector diverging(*beside, *asked.options.certify, made.direction(), go_on);
  const auto found =
      asked.options.step ? of_fixed(made, diverging, go_on) : of_method_with_dense_output(made, diverging, go_on);
  return found && std::isinf(*found) ? beyond : found;
}

}  // namespace pendula
