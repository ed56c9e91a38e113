// Runs of the Taylor method over numbers of many words.
#include "pendula/kernels/long_runs.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/kernels/long_arithmetic.hpp"
#include "pendula/scalar/long_sincos.hpp"

namespace pendula {

namespace {

// Collects states at the request's times as heads and tails.
struct collector {
  std::span<const double> times;
  run_result& to;

  template <class Run>
  void event(const Run&, int, const typename Run::S&) {}
  template <class Run>
  void piece(const Run& run)
    requires requires { run.stepper().joints().senses; }
  {
    to.pieces.times.push_back(rough(run.time().head[0]));
    for (const auto& sense : run.stepper().joints().senses) to.pieces.senses.push_back(rough(sense));
  }
  template <class Run>
  bool step(const Run& run, const typename Run::S& stop) {
    const auto& at = run.stepper().here().head;
    for (std::size_t i = 0; i < at.size() / 2; ++i)
      if (!(std::fabs(rough(at[i])) < largest_long_angle)) return false;
    for (; !times.empty() && reached(run, stop); times = times.subspan(1)) {
      to.times.push_back(times[0]);
      for (const auto& component : run.stepper().state_of(run.stepper().after(run.since_step(times[0])))) {
        const double head = component.rounded();
        to.states.push_back(head);
        to.tails.push_back((component - typename Run::S(head)).rounded());
      }
    }
    return true;
  }
  template <class Run, class S>
  bool reached(const Run& run, const S& stop) const {
    const S left = S(run.direction()) * (stop - run.since_step(times[0]));
    return left.sign >= 0;
  }
};

template <class S, class Entry>
run_result run_of(const request& asked, const watcher& watch) {
  using Sys = typename Entry::template over<S>;
  const std::vector<S> parameters(asked.system.parameters.begin(), asked.system.parameters.end());
  taylor_stepper<Sys> stepper(Entry::template make<S>(asked.system.form, parameters.data()), -S::bits);
  typename Sys::state start;
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = S(asked.state[i]);
  stepper.start(S(asked.t0), start);
  adaptive_run<taylor_stepper<Sys>> run(stepper, asked.t0, asked.end());
  bool going_on = true;
  const double span = asked.end() - asked.t0;
  const auto poll = [&](double t, std::int64_t) { return going_on = watch((t - asked.t0) / span); };
  run_result result;
  const auto end = run.to_end(std::numeric_limits<std::int64_t>::max(), collector{asked.times, result}, poll);
  // a run that its collector ended has an angle out of range
  result.ended = end.ended == outcome::interrupted && going_on ? outcome::not_finite : end.ended;
  result.steps = end.steps;
  result.evaluations = end.evaluations;
  result.reached = end.reached;
  return result;
}

template <int words>
run_result run(const request& asked, const watcher& watch) {
  run_result result;
  result.ended = outcome::not_finite;
  with<systems>(asked.system.name, [&]<class Entry>() {
    if constexpr (takes<taylor, Entry>) result = run_of<long_number<words>, Entry>(asked, watch);
  });
  return result;
}

template <int... words>
constexpr std::array<long_run_kernel, sizeof...(words)> kernels{{{long_number<words>::decimal_digits, run<words>}...}};

}  // namespace

std::span<const long_run_kernel> long_runs() {
#ifdef PENDULA_SANITIZED  // the same code: two counts do
  return kernels<3, 4>;
#else
  return kernels<3, 4, 6, 8, 11, 16>;
#endif
}

}  // namespace pendula
