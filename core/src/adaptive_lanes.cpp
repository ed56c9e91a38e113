// Many trajectories through the lanes of the methods that choose their steps.
#include <algorithm>
#include <functional>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/lanes.hpp"
#include "pendula/kernels/lanes_kernels.hpp"
#include "pendula/kernels/machine.hpp"

namespace {

using namespace pendula;

// Two registers side by side where there are 32 of them: one fills the other's waiting.
constexpr int width = lanes_of_machine == 8 ? 16 : lanes_of_machine;
using S = pack<double, width>;
// AVX2's lanes do for DOP853, which takes as long to compile as all the rest; for that alone where all processors that
// are served have AVX-512.
using for_avx2 = std::conditional_t<least_machine == machine::avx512, std::tuple<dop853>, adaptive_methods_in_lanes>;
using methods_through_lanes = std::conditional_t<lanes_of_machine == 8, std::tuple<taylor>, for_avx2>;

static_assert(no_more_work == no_trajectory);

template <class Entry>
class feed {
 public:
  using Sys = typename Entry::template over<double>;

  feed(const request& asked, const ensemble_rows& rows, ensemble_receiver& to, std::size_t first_output)
      : asked_(asked), rows_(rows), to_(to), first_output_(first_output) {}

  template <class One>
  std::size_t next(One& one) {
    const std::size_t n = to_.next();
    if (n == no_trajectory) return n;
    if (rows_.parameters_apart != 0)
      one.change(Entry::template make<double>(asked_.system.form, rows_.parameters_of(n)));
    const double* const given = rows_.state_of(n);
    if (first_output_ == 1) to_.output(n, 0, given);  // the given state, bit for bit
    typename Sys::state start;
    std::copy_n(given, start.size(), start.begin());
    one.start(asked_.t0, start);
    return n;
  }
  template <class State>
  void output(std::size_t n, std::size_t place, const State& y) {
    to_.output(n, place + first_output_, y.data());
  }
  template <class State>
  void event(std::size_t n, int place, double t, const State& y) {
    to_.event(n, place, t, y.data());
  }
  void finish(const lane_end& end) { to_.finish(end.trajectory, {end.ended, end.steps, end.evaluations, end.reached}); }
  bool go_on() { return to_.go_on(); }

 private:
  const request& asked_;
  const ensemble_rows& rows_;
  ensemble_receiver& to_;
  std::size_t first_output_;
};

// Lanes step together: trajectories whose friction changes from piece to piece run alone, and the terms that are there
// have to be the same in all.
template <class Entry>
bool can_share(const request& asked, const ensemble_rows& rows) {
  using Sys = typename Entry::template over<double>;
  if constexpr (Piecewise<Sys>) {
    const auto system_of = [&](std::size_t n) {
      return Entry::template make<double>(asked.system.form, rows.parameters_of(n));
    };
    const std::size_t different = rows.parameters_apart == 0 ? std::min<std::size_t>(1, rows.count) : rows.count;
    for (std::size_t n = 0; n < different; ++n) {
      const Sys system = system_of(n);
      if (std::ranges::any_of(system.switching(), std::identity{})) return false;
      if constexpr (requires { system.terms(); })
        if (system.terms() != system_of(0).terms()) return false;
    }
  }
  return true;
}

template <class Method, class Entry>
void run_all(const request& asked, const ensemble_rows& rows, ensemble_receiver& to) {
  using One = typename Method::template stepper<typename Entry::template over<double>>;
  using Lanes = typename Method::template stepper<typename Entry::template over<S>>;
  const std::size_t first_output = !asked.times.empty() && asked.times[0] == asked.t0 ? 1 : 0;
  const lanes_task task{asked.t0, asked.end(), asked.step_limit(), std::span(asked.times).subspan(first_output),
                        asked.events};
  const double* const first = rows.parameters.data();
  const std::vector<S> in_lanes(first, first + Entry::forms[asked.system.form].parameters.size());
  const double tolerance = log2_of_tolerance(asked.options);
  One one(Entry::template make<double>(asked.system.form, first), tolerance);
  Lanes lanes(Entry::template make<S>(asked.system.form, in_lanes.data()), tolerance);
  feed<Entry> trajectories(asked, rows, to, first_output);
  lanes_run<Lanes, One, feed<Entry>>(lanes, one, task, trajectories).all();
}

bool run(const request& asked, const ensemble_rows& rows, ensemble_receiver& to) {
  bool built = false;
  with<systems_in_lanes>(asked.system.name, [&]<class Entry>() {
    with<methods_through_lanes>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) {
        using Stepper = typename Method::template stepper<typename Entry::template over<S>>;
        built = (asked.events.empty() || finds_events_in_lanes<Stepper>) && can_share<Entry>(asked, rows);
        if (built) run_all<Method, Entry>(asked, rows, to);
      }
    });
  });
  return built;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const lanes_kernel adaptive_lanes{run};
}  // namespace pendula::PENDULA_MACHINE
