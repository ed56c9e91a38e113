// Runs of one trajectory with the methods of fixed step.
#include <algorithm>
#include <memory>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace {

using namespace pendula;

// Calls visit(drive) with one for the run that is asked for, at its start.
template <class Visit>
void with_drive(const request& asked, Visit&& visit) {
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    const Sys system = Entry::template make<double>(asked.system.form, asked.system.parameters.data());
    typename Sys::state start;
    std::copy_n(asked.state.begin(), start.size(), start.begin());
    std::unique_ptr<fixed_drive<double, Sys::dimension>> made;
    with<fixed_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>)
        made =
            std::make_unique<fixed_run<Method, Sys>>(system, start, asked.t0, asked.signed_step(), asked.step_limit());
    });
    if (made) visit(std::move(made));
  });
}

run_end solve(const request& asked, receiver& to) {
  const double step = asked.signed_step();
  const fixed_plan plan =
      asked.own_steps ? own_steps(asked.t0, step, asked.end()) : requested_times(asked.t0, step, asked.times);
  run_end end;
  with_drive(asked, [&](const auto& drive) {
    const auto sink = [&](std::size_t i, const auto& y) { to.output(i, plan.times[i], y.data()); };
    const auto go_on = [&](std::int64_t steps) { return to.go_on(asked.t0 + static_cast<double>(steps) * step); };
    const lane_result found = drive->through(plan.outputs, sink, go_on)[0];
    const double last = found.outputs > 0 ? plan.times[found.outputs - 1] : asked.t0;
    const double reached = time_reached(found.ended, found.grid_steps, asked.t0, step, last, asked.end());
    end = {found.ended, found.steps, found.evaluations, reached};
  });
  return end;
}

template <std::size_t dimension>
class walk_of final : public grid_walk {
 public:
  using drive = fixed_drive<double, dimension>;

  explicit walk_of(std::unique_ptr<drive> from) : drive_(std::move(from)) {}

  std::unique_ptr<grid_walk> copy() const override { return std::make_unique<walk_of>(drive_->copy()); }
  bool go_to(std::int64_t steps) override { return drive_->go_to(steps); }
  std::int64_t steps() const override { return drive_->steps(); }
  void state(double rest, double* to) const override { std::ranges::copy(drive_->beside(rest), to); }

 private:
  std::unique_ptr<drive> drive_;
};

std::unique_ptr<grid_walk> walk(const request& asked) {
  std::unique_ptr<grid_walk> made;
  with_drive(asked, [&]<std::size_t dimension>(std::unique_ptr<fixed_drive<double, dimension>> drive) {
    made = std::make_unique<walk_of<dimension>>(std::move(drive));
  });
  return made;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const run_kernel fixed_runs{solve, nullptr, walk};
}  // namespace pendula::PENDULA_MACHINE
