#include "pendula/drive/horizon.hpp"

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/drive/fixed_kernels.hpp"
#include "pendula/drive/trust.hpp"

namespace pendula {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

using poll = parting::poll;

struct watcher {
  parting& from;
  double horizon = never;

  template <class Run>
  void event(const Run&, int, double) {}
  template <class Run>
  bool step(const Run& run, double stop) {
    const double right = from.right_in_step(run, stop);
    if (right != stop) horizon = run.time_after(right);
    return right == stop;
  }
};

template <class Stepper>
std::optional<double> of_adaptive(Stepper& stepper, const horizon_request& asked, parting& from, const poll& go_on) {
  adaptive_run<Stepper> run(stepper, asked.t0, asked.end);
  watcher watching{from};
  bool going_on = true;
  const auto ended = run.to_end(std::numeric_limits<std::int64_t>::max(), watching,
                                [&](double t, std::int64_t) { return going_on = go_on(t); });
  if (!going_on || from.stopped()) return std::nullopt;
  return ended.ended == outcome::not_finite ? run.time_after(0.0) : watching.horizon;
}

// Steps where the run has them, at t0 + n h, and the shortened one at the end.
struct step_watcher final : pendula_kernels::fixed_receiver {
  step_watcher(const horizon_request& asked, parting& from, const poll& go_on)
      : asked(asked), from(from), ask(go_on), last(place_on_grid(asked.end, asked.t0, asked.step)) {}

  bool output(std::size_t place, const double* y) override {
    constexpr std::int64_t between_polls = 4096;
    const auto n = static_cast<std::int64_t>(place);
    const wide<double> on_grid = wide<double>(two_product(static_cast<double>(n), asked.step)) + wide<double>(asked.t0);
    const wide<double> time = n > last.steps ? wide<double>(asked.end) : on_grid;
    const std::span state(y, asked.state.size());
    const bool right = in_range(state) && from.right(time, state);
    if (!right) horizon = rounded(time);
    if (n % between_polls == 0) going_on = ask(rounded(time));
    return right && going_on;
  }
  bool go_on(std::int64_t) override { return true; }

  // Finite angles, which have a sine where there is one in the equations: without it neither the run nor the shadow
  // goes on, and that may have millions of turns to go to tell as much.
  bool in_range(std::span<const double> state) const {
    const double range = asked.system == linear_pendulum::name ? never : largest_angle;
    return std::ranges::all_of(state.first(state.size() / 2), [=](double angle) { return std::fabs(angle) < range; });
  }

  const horizon_request& asked;
  parting& from;
  const poll& ask;
  fixed_output last;
  double horizon = never;
  bool going_on = true;
};

std::optional<double> of_fixed(const horizon_request& asked, parting& from, const poll& go_on) {
  step_watcher watching(asked, from, go_on);
  pendula_kernels::fixed_plain.each_step({asked.system, asked.form, asked.parameters.data(), asked.method,
                                          asked.state.data(), asked.step, std::numeric_limits<std::int64_t>::max()},
                                         watching.last, watching);
  if (from.stopped() || (!watching.going_on && watching.horizon == never)) return std::nullopt;
  return watching.horizon;
}

template <class Entry>
std::optional<double> of_system(const horizon_request& asked, parting& from, const poll& go_on) {
  using Sys = typename Entry::template over<double>;
  const Sys system = Entry::template make<double>(asked.form, asked.parameters.data());
  typename Sys::state start;
  std::ranges::copy(asked.state, start.begin());
  std::optional<double> found;
  with<adaptive_methods>(asked.method, [&]<class Method>() {
    typename Method::template stepper<Sys> stepper(system, asked.log2_of_tolerance);
    stepper.start(start);
    found = of_adaptive(stepper, asked, from, go_on);
  });
  return found;
}

}  // namespace

std::optional<double> trust_horizon(const horizon_request& asked, const poll& go_on) {
  const double direction = asked.end < asked.t0 ? -1.0 : 1.0;
  const auto beside = pendula_kernels::best_shadow_maker().make(
      {asked.system, asked.form, asked.parameters.data(), asked.state.data(), asked.t0, direction});
  parting from(*beside, asked.certify, direction, go_on);
  if (asked.step != 0.0) return of_fixed(asked, from, go_on);
  std::optional<double> found;
  with<systems>(asked.system, [&]<class Entry>() { found = of_system<Entry>(asked, from, go_on); });
  return found;
}

}  // namespace pendula
