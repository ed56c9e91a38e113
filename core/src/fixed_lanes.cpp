// Many trajectories through the lanes of the methods of fixed step.
#include <array>
#include <memory>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/kernels/lanes_kernels.hpp"

namespace {

using namespace pendula;

constexpr int width = 2 * lanes_of_machine;  // one register fills the other's waiting
using S = pack<double, width>;

// The trajectories that move in lock step: all of them take the same steps.
struct group {
  std::array<std::size_t, width> trajectories;
  int count = 0;

  explicit group(ensemble_receiver& to) {
    while (count < width && (trajectories[count] = to.next()) != no_more_work) ++count;
  }
  std::size_t in_lane(int l) const { return trajectories[l < count ? l : 0]; }  // the last ones may be the first again
};

template <class Sys>
using drive_of = std::unique_ptr<fixed_drive<S, Sys::dimension>>;
template <class Sys>
using maker_of = drive_of<Sys> (*)(const Sys&, const typename Sys::state&, const request&);

template <class Entry, class Sys = typename Entry::template over<S>>
void run_group(const group& some, const request& asked, const ensemble_rows& rows,
               std::span<const fixed_output> outputs, ensemble_receiver& to, maker_of<Sys> make) {
  constexpr std::size_t d = Sys::dimension;
  std::vector<S> parameters(Entry::forms[asked.system.form].parameters.size());
  typename Sys::state start;
  for (int l = 0; l < width; ++l) {
    const std::size_t n = some.in_lane(l);
    for (std::size_t i = 0; i < parameters.size(); ++i) set_lane(parameters[i], l, rows.parameters_of(n)[i]);
    for (std::size_t i = 0; i < d; ++i) set_lane(start[i], l, rows.state_of(n)[i]);
  }
  const drive_of<Sys> drive = make(Entry::template make<S>(asked.system.form, parameters.data()), start, asked);
  const auto sink = [&](std::size_t place, const auto& y) {
    for (int l = 0; l < some.count; ++l) {
      std::array<double, d> mine;
      for (std::size_t i = 0; i < d; ++i) mine[i] = lane(y[i], l);
      to.output(some.trajectories[l], place, mine.data());
    }
  };
  const auto results = drive->through(outputs, sink, [&](std::int64_t) { return to.go_on(); });
  for (int l = 0; l < some.count; ++l) {
    const lane_result& found = results[l];
    const double last = found.outputs > 0 ? asked.times[found.outputs - 1] : asked.t0;
    const double reached =
        time_reached(found.ended, found.grid_steps, asked.t0, asked.signed_step(), last, asked.end());
    to.finish(some.trajectories[l], {found.ended, found.steps, found.evaluations, reached});
  }
}

template <class Method, class Sys>
drive_of<Sys> made(const Sys& system, const typename Sys::state& start, const request& asked) {
  return std::make_unique<fixed_run<Method, Sys>>(system, start, asked.t0, asked.signed_step(), asked.step_limit());
}

bool run(const request& asked, const ensemble_rows& rows, ensemble_receiver& to) {
  const auto outputs = requested_times(asked.t0, asked.signed_step(), asked.times).outputs;
  bool built = false;
  with<systems_in_lanes>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<S>;
    maker_of<Sys> make = nullptr;
    with<fixed_methods_in_lanes>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) make = made<Method, Sys>;
    });
    built = make != nullptr;
    if (!built) return;
    for (group some(to); some.count > 0 && to.go_on(); some = group(to))
      run_group<Entry>(some, asked, rows, outputs, to, make);
  });
  return built;
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const lanes_kernel fixed_lanes{run};
}  // namespace pendula::PENDULA_MACHINE
