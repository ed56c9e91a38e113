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

template <std::size_t d>
void tell(const std::array<number, d>& y, double* values, double* changes) {
  for (std::size_t i = 0; i < d; ++i) {
    if (values) values[i] = y[i].value;
    for (int column = 0; column < static_cast<int>(derived_at_once); ++column) *changes++ = y[i].change[column];
  }
}

// The step that a run stands in.
template <class Run>
struct step_of final : derived_step {
  explicit step_of(const Run& run) : run(run) {}

  double start() const override { return run.time_after(number(0.0)); }
  // At a fixed time: where that of the step's start changes, the time since then does so, too.
  void at(double tau, double* values, double* changes) const override {
    const auto& time = run.time();
    const number since(tau, -(time.head[0].change + time.tail[0].change));
    tell(run.stepper().state_of(run.stepper().after(since)), values, changes);
  }

  const Run& run;
};

template <class Run>
class reporter {
 public:
  static constexpr std::size_t dimension = std::tuple_size_v<typename Run::state>;

  // `told`: the outputs are those of a run that was made; its last one can be an event's, between two bits of its time.
  reporter(std::span<const double> outputs, bool told, derivative_receiver& to)
      : outputs_(outputs), told_(told), to_(to) {}

  bool step(const Run& run, const number& stop) {
    const step_of<Run> here(run);
    for (; next_ < outputs_.size(); ++next_) {
      const number tau = run.since_step(outputs_[next_]);
      const bool of_event = told_ && run.terminated();
      if (!of_event && tau.value * run.direction() > stop.value * run.direction()) break;
      to_.output(here, tau.value);
    }
    to_.step(here, stop.value);
    return true;
  }
  // At an event's own time, which changes too.
  void event(const Run& run, int place, const number& tau) {
    const auto [head, tail] = later(head_and_tail<number>{run.time().head[0], run.time().tail[0]}, tau);
    const auto y = run.stepper().state_of(run.stepper().after(tau));
    std::array<double, derived_at_once> of_time;
    std::array<double, dimension> state;
    std::array<double, dimension * derived_at_once> of_state;
    tell(std::array{head + tail}, nullptr, of_time.data());
    tell(y, state.data(), of_state.data());
    to_.event(place, head.value, state.data(), of_time.data(), of_state.data());
  }
  void moved(Run& run) {
    const double* const matrix = to_.mixing();
    if (!matrix) return;
    run.each_number([matrix](number& x) {
      number::tangents mixed(0.0);
      for (int i = 0; i < static_cast<int>(derived_at_once); ++i) {
        number::tangents row;
        load(matrix + i * static_cast<int>(derived_at_once), row);
        mixed = mixed + number::tangents(x.change[i]) * row;
      }
      x.change = mixed;
    });
  }

 private:
  std::span<const double> outputs_;
  std::size_t next_ = 0;
  bool told_;
  derivative_receiver& to_;
};

// Numbers with the changes that stand at a place.
std::vector<number> seeded(const std::vector<double>& values, const double* changes) {
  std::vector<number> all;
  for (const double x : values) {
    number::tangents change;
    load(changes, change);
    changes += derived_at_once;
    all.emplace_back(x, change);
  }
  return all;
}

template <class Entry>
run_end run_of(const request& asked, std::span<const double> outputs, first_changes changes, derivative_receiver& to) {
  using Sys = typename Entry::template over<number>;
  using Run = adaptive_run<taylor_stepper<Sys>>;
  const auto state = seeded(asked.state, changes.data());
  const auto parameters = seeded(asked.system.parameters, changes.data() + state.size() * derived_at_once);
  typename Sys::state start;
  std::ranges::copy(state, start.begin());
  taylor_stepper<Sys> stepper(Entry::template make<number>(asked.system.form, parameters.data()),
                              log2_of_tolerance(asked.options));
  stepper.start(number(asked.t0), start);
  const auto found = Run(stepper, asked.t0, asked.end(), asked.events)
                         .to_end(asked.step_limit(), reporter<Run>(outputs, asked.own_steps, to),
                                 [&](double t, std::int64_t) { return to.go_on(t); });
  return {found.ended, found.steps, found.evaluations, found.reached};
}

run_end run(const request& asked, std::span<const double> outputs, first_changes changes, derivative_receiver& to) {
  run_end ended;
  with<systems>(asked.system.name, [&]<class Entry>() {
    if constexpr (takes<taylor, Entry>) ended = run_of<Entry>(asked, outputs, changes, to);
  });
  return ended;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const derivative_kernel derivative_runs{run};
}  // namespace pendula::PENDULA_MACHINE
