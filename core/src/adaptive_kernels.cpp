// Built once for each machine, with its options and `pendula` defined as a name of its own, so that no inline function
// of one build can stand in for that of another.
#include "pendula/drive/adaptive_kernels.hpp"

#include <cmath>
#include <cstring>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"

namespace {

using namespace pendula;
using pendula_kernels::adaptive_outcome;
using pendula_kernels::adaptive_request;
using pendula_kernels::event_row;
using pendula_kernels::receiver;
using pendula_kernels::step_memory;

template <class Memory>
step_memory packed(const compensated_point<vec<double, 1>>& time, const Memory& memory) {
  static_assert(sizeof time + sizeof memory <= sizeof(step_memory));
  step_memory all{};
  std::memcpy(all.data(), &time, sizeof time);
  std::memcpy(all.data() + 2, &memory, sizeof memory);
  return all;
}

// Hands on what the drive tells; states are computed only where there is an output.
template <class Run>
class teller {
 public:
  teller(std::span<const double> times, receiver& to) : times_(times), to_(to) {}

  bool step(const Run& run, double stop) {
    to_.step(packed(run.time(), run.stepper().remembered()));
    if (times_.empty()) {
      const bool at_end = stop == run.since_step(run.end());
      tell(run, at_end ? run.end() : last_time_in_step(run, stop));
    }
    for (; next_ < times_.size() && reached(run, stop); ++next_) tell(run, times_[next_]);
    return true;
  }
  void event(const Run& run, int place, double tau) {
    const auto y = run.stepper().state_of(run.stepper().after(tau));
    to_.event(place, run.time_after(tau), y.data());
  }

 private:
  bool reached(const Run& run, double stop) const {
    return run.since_step(times_[next_]) * run.direction() <= stop * run.direction();
  }
  // Where the step stops; not after its end, so that an output asked for at that time comes from this step, too.
  static double last_time_in_step(const Run& run, double stop) {
    const double t = run.time_after(stop), length = run.stepper().length();
    const bool beyond = run.since_step(t) * run.direction() > length * run.direction();
    return beyond ? std::nextafter(t, -run.direction() * HUGE_VAL) : t;
  }
  void tell(const Run& run, double t) {
    const auto y = run.stepper().state_of(run.stepper().after(run.since_step(t)));
    to_.output(t, y.data());
  }

  std::span<const double> times_;
  receiver& to_;
  std::size_t next_ = 0;
};

// Calls visit(stepper, state) for what is asked for; the stepper stands at the start.
template <class Visit>
adaptive_outcome with_stepper(const adaptive_request& asked, Visit&& visit) {
  adaptive_result result;
  with<systems>(asked.system, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    const Sys system = Entry::template make<double>(asked.form, asked.parameters);
    with<adaptive_methods>(asked.method, [&]<class Method>() {
      typename Method::template stepper<Sys> stepper(system, asked.log2_of_tolerance);
      typename Sys::state start;
      std::copy_n(asked.state, start.size(), start.begin());
      stepper.start(start);
      result = visit(stepper);
    });
  });
  return {static_cast<std::uint8_t>(result.ended), result.steps, result.evaluations, result.reached};
}

std::vector<event> events_of(std::span<const event_row> rows) {
  std::vector<event> events;
  for (const event_row& row : rows)
    events.push_back({static_cast<event_kind>(row.kind), row.index, row.value, row.value_tail, row.every_turn,
                      row.direction, row.at_most});
  return events;
}

auto asked_of(receiver& to) {
  return [&to](double t, std::int64_t steps) { return to.go_on(t, steps); };
}

adaptive_outcome solve(const adaptive_request& asked, std::span<const double> times, std::span<const event_row> rows,
                       receiver& to) {
  if (times.empty() || times[0] == asked.t0) to.output(asked.t0, asked.state);  // as it was given
  if (!times.empty() && times[0] == asked.t0) times = times.subspan(1);
  if (asked.end == asked.t0) return {static_cast<std::uint8_t>(outcome::reached_end), 0, 0, asked.t0};
  const std::vector<event> events = events_of(rows);
  return with_stepper(asked, [&]<class Stepper>(Stepper& stepper) {
    adaptive_run<Stepper> run(stepper, asked.t0, asked.end, events);
    return run.to_end(asked.step_limit, teller<adaptive_run<Stepper>>(times, to), asked_of(to));
  });
}

adaptive_outcome revisit(const adaptive_request& asked, const step_memory& from, std::span<const double> times,
                         receiver& to) {
  return with_stepper(asked, [&]<class Stepper>(Stepper& stepper) {
    compensated_point<vec<double, 1>> time;
    typename Stepper::memory memory;
    std::memcpy(&time, from.data(), sizeof time);
    std::memcpy(&memory, from.data() + 2, sizeof memory);
    stepper.resume(memory);
    adaptive_run<Stepper> run(stepper, time, times.back(), asked.end < asked.t0 ? -1.0 : 1.0);
    return run.to_end(asked.step_limit, teller<adaptive_run<Stepper>>(times, to), asked_of(to));
  });
}

}  // namespace

namespace pendula_kernels {
extern const adaptive PENDULA_KERNELS{solve, revisit};
}  // namespace pendula_kernels
