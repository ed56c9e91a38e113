// Built once for each machine, with its options and `pendula` defined as a name of its own, so that no inline function
// of one build can stand in for that of another.
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/ensemble_kernels.hpp"
#include "pendula/drive/lanes.hpp"

namespace {

using namespace pendula;
using pendula_kernels::ensemble_receiver;
using pendula_kernels::ensemble_request;

// Two registers side by side where there are 32 of them: one fills the other's waiting.
constexpr int width = lanes_of_machine == 8 ? 16 : lanes_of_machine;
using S = pack<double, width>;
// AVX2's lanes do for DOP853, which takes as long to compile as all the rest.
using methods_through_lanes = std::conditional_t<lanes_of_machine == 8, std::tuple<taylor>, adaptive_methods>;

static_assert(pendula_kernels::no_more == no_trajectory);

template <class Entry>
class feed {
 public:
  using Sys = typename Entry::template over<double>;

  feed(const ensemble_request& asked, ensemble_receiver& to, std::size_t first_output)
      : asked_(asked), to_(to), first_output_(first_output) {}

  template <class One>
  std::size_t next(One& one) {
    const std::size_t n = to_.next();
    if (n == no_trajectory) return n;
    if (asked_.parameters_apart != 0)
      one.change(Entry::template make<double>(asked_.form, asked_.parameters + n * asked_.parameters_apart));
    const double* const given = asked_.states + n * Sys::dimension;
    if (first_output_ == 1) to_.output(n, 0, given);  // as it was given
    typename Sys::state start;
    std::copy_n(given, start.size(), start.begin());
    one.start(start);
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
  void finish(const lane_end& end) {
    to_.finish(end.trajectory, static_cast<std::uint8_t>(end.ended), end.steps, end.reached);
  }
  bool go_on() { return to_.go_on(); }

 private:
  const ensemble_request& asked_;
  ensemble_receiver& to_;
  std::size_t first_output_;
};

bool run(const ensemble_request& asked, std::span<const pendula_kernels::fixed_place>, ensemble_receiver& to) {
  std::vector<event> events;
  for (const auto& row : asked.events)
    events.push_back({static_cast<event_kind>(row.kind), row.index, row.value, row.value_tail, row.every_turn,
                      row.direction, row.at_most});
  const std::size_t first_output = !asked.times.empty() && asked.times[0] == asked.t0 ? 1 : 0;
  const lanes_task task{asked.t0, asked.end, asked.step_limit, asked.times.subspan(first_output), events};
  bool built = false;
  with<systems>(asked.system, [&]<class Entry>() {
    built = with<methods_through_lanes>(asked.method, [&]<class Method>() {
      using One = typename Method::template stepper<typename Entry::template over<double>>;
      using Lanes = typename Method::template stepper<typename Entry::template over<S>>;
      const std::size_t count = Entry::forms[asked.form].parameters.size();
      const std::vector<S> in_lanes(asked.parameters, asked.parameters + count);
      One one(Entry::template make<double>(asked.form, asked.parameters), asked.log2_of_tolerance);
      Lanes lanes(Entry::template make<S>(asked.form, in_lanes.data()), asked.log2_of_tolerance);
      feed<Entry> trajectories(asked, to, first_output);
      lanes_run<Lanes, One, feed<Entry>>(lanes, one, task, trajectories).all();
    });
  });
  return built;
}

}  // namespace

namespace pendula_kernels {
extern const lanes_kernel PENDULA_KERNELS{run};
}  // namespace pendula_kernels
