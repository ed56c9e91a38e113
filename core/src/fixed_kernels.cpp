#include "pendula/drive/fixed_kernels.hpp"

#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"

namespace {

using namespace pendula;
using namespace pendula_kernels;

// Calls visit(drive) for the run that is asked for.
template <class Visit>
void with_drive(const fixed_request& asked, Visit&& visit) {
  with<systems>(asked.system, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    const Sys system = Entry::template make<double>(asked.form, asked.parameters);
    typename Sys::state start;
    std::copy_n(asked.state, start.size(), start.begin());
    with<fixed_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) {
        fixed_run<Method, Sys> drive(system, start, asked.step, asked.step_limit);
        visit(drive);
      }
    });
  });
}

fixed_outcome run(const fixed_request& asked, std::span<const fixed_place> places, fixed_receiver& to) {
  lane_result result;
  with_drive(asked, [&](auto& drive) {
    const auto sink = [&](std::size_t i, const auto& y) { to.output(i, y.data()); };
    result = drive.through(places, sink, [&](std::int64_t steps) { return to.go_on(steps); })[0];
  });
  return {static_cast<std::uint8_t>(result.ended), result.outputs, result.steps, result.evaluations};
}

void each_step(const fixed_request& asked, fixed_place last, fixed_receiver& to) {
  with_drive(asked, [&](auto& drive) {
    drive.each_step(last,
                    [&](std::int64_t n, const auto& y) { return to.output(static_cast<std::size_t>(n), y.data()); });
  });
}

}  // namespace

namespace pendula_kernels {
extern const fixed PENDULA_KERNELS{run, each_step};
}  // namespace pendula_kernels
