// Runs of one trajectory with the methods of fixed step.
#include <algorithm>
#include <memory>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace {

using namespace pendula;

// Calls visit.operator()<Method>(system, start) for the run that is asked for.
template <class Visit>
void with_entries(const request& asked, Visit&& visit) {
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    const Sys system = Entry::template make<double>(asked.system.form, asked.system.parameters.data());
    typename Sys::state start;
    std::copy_n(asked.state.begin(), start.size(), start.begin());
    with<fixed_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) visit.template operator()<Method>(system, start);
    });
  });
}

run_end solve(const request& asked, receiver& to) {
  const double step = asked.signed_step();
  const fixed_plan plan =
      asked.own_steps ? own_steps(asked.t0, step, asked.end()) : requested_times(asked.t0, step, asked.times);
  run_end end;
  with_entries(asked, [&]<class Method, class Sys>(const Sys& system, const typename Sys::state& start) {
    fixed_run<Method, Sys> drive(system, start, asked.t0, step, asked.step_limit());
    const auto sink = [&](std::size_t i, const auto& y) { to.output(i, plan.times[i], y.data()); };
    const auto go_on = [&](std::int64_t steps) { return to.go_on(asked.t0 + static_cast<double>(steps) * step); };
    const lane_result found = drive.through(plan.outputs, sink, go_on)[0];
    const double last = found.outputs > 0 ? plan.times[found.outputs - 1] : asked.t0;
    const double reached = time_reached(found.ended, found.grid_steps, asked.t0, step, last, asked.end());
    end = {found.ended, found.steps, found.evaluations, reached};
  });
  return end;
}

template <class Method, class Sys>
class walk_of final : public grid_walk {
 public:
  walk_of(const Sys& system, const typename Sys::state& start, const request& asked)
      : system_(std::make_shared<const Sys>(system)),
        drive_(*system_, start, asked.t0, asked.signed_step(), asked.step_limit()) {}

  std::unique_ptr<grid_walk> copy() const override { return std::make_unique<walk_of>(*this); }
  bool go_to(std::int64_t steps) override { return drive_.go_to(steps); }
  std::int64_t steps() const override { return drive_.steps(); }
  void state(double rest, double* to) const override { std::ranges::copy(drive_.beside(rest), to); }

 private:
  std::shared_ptr<const Sys> system_;  // that all copies run in
  fixed_run<Method, Sys> drive_;
};

std::unique_ptr<grid_walk> walk(const request& asked) {
  std::unique_ptr<grid_walk> made;
  with_entries(asked, [&]<class Method, class Sys>(const Sys& system, const typename Sys::state& start) {
    made = std::make_unique<walk_of<Method, Sys>>(system, start, asked);
  });
  return made;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const run_kernel fixed_runs{solve, nullptr, walk};
}  // namespace pendula::PENDULA_MACHINE
