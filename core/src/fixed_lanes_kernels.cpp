// Built once for each machine, with its options and `pendula` defined as a name of its own, so that no inline function
// of one build can stand in for that of another.
#include <array>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/ensemble_kernels.hpp"
#include "pendula/drive/fixed.hpp"

namespace {

using namespace pendula;
using pendula_kernels::ensemble_receiver;
using pendula_kernels::ensemble_request;

constexpr int width = 2 * lanes_of_machine;  // one register fills the other's waiting
using S = pack<double, width>;

// The trajectories that move in lock step: all of them take the same steps.
struct group {
  std::array<std::size_t, width> trajectories;
  int count = 0;

  explicit group(ensemble_receiver& to) {
    while (count < width && (trajectories[count] = to.next()) != pendula_kernels::no_more) ++count;
  }
  std::size_t in_lane(int l) const { return trajectories[l < count ? l : 0]; }  // the last ones may be the first again
};

template <class Method, class Entry>
void run_group(const group& some, const ensemble_request& asked, std::span<const fixed_output> outputs,
               ensemble_receiver& to) {
  using Sys = typename Entry::template over<S>;
  constexpr std::size_t d = Sys::dimension;
  std::vector<S> parameters(Entry::forms[asked.form].parameters.size());
  typename Sys::state start;
  for (int l = 0; l < width; ++l) {
    const std::size_t n = some.in_lane(l);
    for (std::size_t i = 0; i < parameters.size(); ++i)
      set_lane(parameters[i], l, asked.parameters[n * asked.parameters_apart + i]);
    for (std::size_t i = 0; i < d; ++i) set_lane(start[i], l, asked.states[n * d + i]);
  }
  const Sys system = Entry::template make<S>(asked.form, parameters.data());
  const auto sink = [&](std::size_t place, const auto& y) {
    for (int l = 0; l < some.count; ++l) {
      std::array<double, d> mine;
      for (std::size_t i = 0; i < d; ++i) mine[i] = lane(y[i], l);
      to.output(some.trajectories[l], place, mine.data());
    }
  };
  fixed_run<Method, Sys> drive(system, start, asked.step, asked.step_limit);
  const auto results = drive.through(outputs, sink, [&](std::int64_t) { return to.go_on(); });
  for (int l = 0; l < some.count; ++l) {
    const auto& [ended, outputs_reached, steps, evaluations] = results[l];
    const double until = ended == outcome::reached_end ? asked.end : asked.t0 + static_cast<double>(steps) * asked.step;
    to.finish(some.trajectories[l], static_cast<std::uint8_t>(ended), steps, until);
  }
}

bool run(const ensemble_request& asked, std::span<const fixed_output> places, ensemble_receiver& to) {
  bool built = false;
  with<systems>(asked.system, [&]<class Entry>() {
    built = with<fixed_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>)
        for (group some(to); some.count > 0 && to.go_on(); some = group(to))
          run_group<Method, Entry>(some, asked, places, to);
    });
  });
  return built;
}

}  // namespace

namespace pendula_kernels {
extern const lanes_kernel PENDULA_KERNELS{run};
}  // namespace pendula_kernels
