// Runs of the Taylor method over numbers that carry their derivatives.
#include <algorithm>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/kernels/derivatives.hpp"
#include "pendula/scalar/dual.hpp"

namespace {

using namespace pendula;

using number = dual<derived_at_once>;

template <class Run>
class reporter {
 public:
  reporter(std::span<const double> outputs, double t0, derivative_receiver& to) : outputs_(outputs), to_(to) {
    while (next_ < outputs_.size() && outputs_[next_] == t0) ++next_;  // told before the run
  }

  bool step(const Run& run, const number& stop) {
    for (; next_ < outputs_.size(); ++next_) {
      const number tau = run.since_step(outputs_[next_]);
      if (!run.terminated() && tau.value * run.direction() > stop.value * run.direction()) break;
      to_.output(changes_of(run.stepper().state_of(run.stepper().after(tau))).data());
    }
    return true;
  }
  // At an event's own time, which changes too.
  void event(const Run& run, int place, const number& tau) {
    const auto [head, tail] = later(head_and_tail<number>{run.time().head[0], run.time().tail[0]}, tau);
    const auto y = run.stepper().state_of(run.stepper().after(tau));
    to_.event(place, changes_of(std::array{head + tail}).data(), changes_of(y).data());
  }

 private:
  template <std::size_t d>
  static std::array<double, d * derived_at_once> changes_of(const std::array<number, d>& y) {
    std::array<double, d * derived_at_once> all;
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = y[i / derived_at_once].change[static_cast<int>(i % derived_at_once)];
    return all;
  }

  std::span<const double> outputs_;
  std::size_t next_ = 0;
  derivative_receiver& to_;
};

// Numbers of which some are derived by: `first` is the column's number of the first of them.
std::vector<number> seeded(const std::vector<double>& values, std::size_t first, std::span<const derived_by> columns) {
  std::vector<number> all(values.begin(), values.end());
  for (std::size_t column = 0; column < columns.size(); ++column)
    if (const std::size_t place = columns[column] - first; columns[column] >= first && place < all.size())
      all[place].change.set(static_cast<int>(column), 1.0);
  return all;
}

template <class Entry>
outcome run_of(const request& asked, std::span<const double> outputs, std::span<const derived_by> columns,
               derivative_receiver& to) {
  using Sys = typename Entry::template over<number>;
  using Run = adaptive_run<taylor_stepper<Sys>>;
  const auto parameters = seeded(asked.system.parameters, asked.state.size(), columns);
  const auto state = seeded(asked.state, 0, columns);
  typename Sys::state start;
  std::ranges::copy(state, start.begin());
  taylor_stepper<Sys> stepper(Entry::template make<number>(asked.system.form, parameters.data()),
                              log2_of_tolerance(asked.options));
  stepper.start(number(asked.t0), start);
  Run run(stepper, asked.t0, asked.end(), asked.events);
  return run
      .to_end(asked.step_limit(), reporter<Run>(outputs, asked.t0, to),
              [&](double t, std::int64_t) { return to.go_on(t); })
      .ended;
}

outcome run(const request& asked, std::span<const double> outputs, std::span<const derived_by> columns,
            derivative_receiver& to) {
  outcome ended{};
  with<systems>(asked.system.name, [&]<class Entry>() {
    if constexpr (takes<taylor, Entry>) ended = run_of<Entry>(asked, outputs, columns, to);
  });
  return ended;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const derivative_kernel derivative_runs{run};
}  // namespace pendula::PENDULA_MACHINE
