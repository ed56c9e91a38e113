// Runs of one trajectory with the methods of fixed step.
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace {

using namespace pendula;

// Calls visit(drive) for the run that is asked for.
template <class Visit>
void with_drive(const request& asked, Visit&& visit) {
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    const Sys system = Entry::template make<double>(asked.system.form, asked.system.parameters.data());
    typename Sys::state start;
    std::copy_n(asked.state.begin(), start.size(), start.begin());
    with<fixed_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) {
        fixed_run<Method, Sys> drive(system, start, asked.t0, asked.signed_step(), asked.step_limit());
        visit(drive);
      }
    });
  });
}

run_end solve(const request& asked, receiver& to) {
  const double step = asked.signed_step();
  const fixed_plan plan =
      asked.own_steps ? own_steps(asked.t0, step, asked.end()) : requested_times(asked.t0, step, asked.times);
  run_end end;
  with_drive(asked, [&](auto& drive) {
    const auto sink = [&](std::size_t i, const auto& y) { to.output(i, plan.times[i], y.data()); };
    const auto go_on = [&](std::int64_t steps) { return to.go_on(asked.t0 + static_cast<double>(steps) * step); };
    const lane_result found = drive.through(plan.outputs, sink, go_on)[0];
    const double last = found.outputs > 0 ? plan.times[found.outputs - 1] : asked.t0;
    const double reached = time_reached(found.ended, found.grid_steps, asked.t0, step, last, asked.end());
    end = {found.ended, found.steps, found.evaluations, reached};
  });
  return end;
}

void each_step(const request& asked, receiver& to) {
  const fixed_output last = place_on_grid(asked.end(), asked.t0, asked.signed_step());
  with_drive(asked, [&](auto& drive) {
    drive.each_step(last, [&](std::int64_t n, const auto& y) {
      const double t = n > last.steps ? asked.end() : asked.t0 + static_cast<double>(n) * asked.signed_step();
      return to.output(static_cast<std::size_t>(n), t, y.data());
    });
  });
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const run_kernel fixed_runs{solve, nullptr, each_step};
}  // namespace pendula::PENDULA_MACHINE
