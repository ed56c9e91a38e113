// Built for some counts of words at a time, so that the parts compile side by side.
#include "pendula/drive/long_runs.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/scalar/long_sincos.hpp"

namespace pendula {

namespace {

// Beyond it little is left of a double's turn, and the sine's count of quarter turns would not be exact.
constexpr double largest_long_angle = 0x1p50;

struct writer {
  std::span<const double> times;
  double* to;

  template <class Run>
  void event(const Run&, int, const typename Run::S&) {}
  template <class Run>
  bool step(const Run& run, const typename Run::S& stop) {
    const auto& at = run.stepper().remembered().head;
    for (std::size_t i = 0; i < at.size() / 2; ++i)
      if (!(std::fabs(rough(at[i])) < largest_long_angle)) return false;
    for (; !times.empty() && reached(run, stop); times = times.subspan(1)) {
      for (const auto& component : run.stepper().state_of(run.stepper().after(run.since_step(times[0])))) {
        const double head = component.rounded();
        *to++ = head;
        *to++ = (component - typename Run::S(head)).rounded();
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
outcome run_of(const long_run_request& asked, double* states, const std::function<bool(double)>& go_on) {
  using Sys = typename Entry::template over<S>;
  const std::vector<S> parameters(asked.parameters.begin(), asked.parameters.end());
  taylor_stepper<Sys> stepper(Entry::template make<S>(asked.form, parameters.data()), -S::bits);
  typename Sys::state start;
  for (std::size_t i = 0; i < start.size(); ++i) start[i] = S(asked.state[i]);
  stepper.start(start);
  adaptive_run<taylor_stepper<Sys>> run(stepper, asked.t0, asked.times.back());
  bool going_on = true;
  const auto poll = [&](double t, std::int64_t) { return going_on = go_on(t); };
  const auto ended = run.to_end(std::numeric_limits<std::int64_t>::max(), writer{asked.times, states}, poll).ended;
  return ended == outcome::interrupted && going_on ? outcome::not_finite : ended;
}

template <int words>
outcome run(const long_run_request& asked, double* states, const std::function<bool(double)>& go_on) {
  outcome ended = outcome::not_finite;
  with<systems>(asked.system, [&]<class Entry>() { ended = run_of<long_number<words>, Entry>(asked, states, go_on); });
  return ended;
}

template <int... words>
constexpr std::array<long_run_kernel, sizeof...(words)> kernels{{{long_number<words>::decimal_digits, run<words>}...}};

}  // namespace

std::span<const long_run_kernel> PENDULA_PART() { return kernels<PENDULA_WORDS>; }

}  // namespace pendula
