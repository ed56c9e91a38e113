// Runs of one trajectory with the methods that choose their steps.
#include <cmath>
#include <cstring>

#include "pendula/catalog.hpp"
#include "pendula/drive/adaptive.hpp"
#include "pendula/kernels/run_kernels.hpp"

namespace {

using namespace pendula;

template <class Memory>
void pack(const compensated_point<vec<double, 1>>& time, const Memory& memory, step_memory& all) {
  static_assert(sizeof time + sizeof memory <= sizeof all.numbers);
  std::memcpy(all.numbers.data(), &time, sizeof time);
  std::memcpy(all.numbers.data() + 2, &memory, sizeof memory);
  all.count = (sizeof time + sizeof memory) / sizeof(double);
}

// The step that a run stands in, for those who look inside it.
template <class Run>
struct motion_of final : step_motion {
  motion_of(const Run& run, double stop) : run(run), length(stop) {}

  two_doubles start() const override { return {run.time().head[0], run.time().tail[0]}; }
  double stop() const override { return length; }
  double time_after(double tau) const override { return run.time_after(tau); }
  void angles(double tau, double* to) const override {
    const auto y = run.stepper().after(tau).head;
    std::copy_n(y.begin(), y.size() / 2, to);
  }
  void state(double tau, double* to) const override {
    std::ranges::copy(run.stepper().state_of(run.stepper().after(tau)), to);
  }
  void remember(step_memory& to) const override { pack(run.time(), run.stepper().remembered(), to); }

  const Run& run;
  double length;
};

// Sends outputs and events to a receiver; states are computed only where there is an output.
template <class Run>
class reporter {
 public:
  // Outputs at the times, or, where there are none, at every step and the end; `next`: the place of the first.
  reporter(std::span<const double> times, std::size_t next, receiver& to) : times_(times), next_(next), to_(to) {}

  bool step(const Run& run, double stop) {
    const bool go_on = to_.step(motion_of<Run>(run, stop));
    if (times_.empty()) {
      const bool at_end = stop == run.since_step(run.end());
      if (run.terminated()) {
        to_.output(next_++, last_event_.t, last_event_.y.data());
      } else {
        output(run, at_end ? run.end() : last_time_in_step(run, stop));
      }
    }
    while (next_ < times_.size() && reached(run, stop)) output(run, times_[next_]);
    return go_on;
  }
  void event(const Run& run, int place, double tau) {
    last_event_ = {run.time_after(tau), run.stepper().state_of(run.stepper().after(tau))};
    to_.event(place, last_event_.t, last_event_.y.data());
  }
  void piece(const Run& run)
    requires requires { run.stepper().joints().senses; }
  {
    to_.piece(run.time().head[0], run.stepper().joints().senses);
  }

 private:
  struct event_passed {
    double t;
    typename Run::state y;
  };

  bool reached(const Run& run, double stop) const {
    return run.since_step(times_[next_]) * run.direction() <= stop * run.direction();
  }
  // Where the step stops; not after its end, so that an output asked for at that time comes from this step, too.
  static double last_time_in_step(const Run& run, double stop) {
    const double t = run.time_after(stop), length = run.stepper().length();
    const bool beyond = run.since_step(t) * run.direction() > length * run.direction();
    return beyond ? std::nextafter(t, -run.direction() * HUGE_VAL) : t;
  }
  void output(const Run& run, double t) {
    const auto y = run.stepper().state_of(run.stepper().after(run.since_step(t)));
    to_.output(next_++, t, y.data());
  }

  std::span<const double> times_;
  std::size_t next_;
  receiver& to_;
  event_passed last_event_{};  // the state with which a run that it ends goes on elsewhere
};

// Calls visit(stepper) for what is asked for; the stepper stands at the start.
template <class Visit>
run_end with_stepper(const request& asked, Visit&& visit) {
  adaptive_result result;
  with<systems>(asked.system.name, [&]<class Entry>() {
    using Sys = typename Entry::template over<double>;
    const Sys system = Entry::template make<double>(asked.system.form, asked.system.parameters.data());
    with<adaptive_methods>(asked.method, [&]<class Method>() {
      if constexpr (takes<Method, Entry>) {
        typename Method::template stepper<Sys> stepper(system, log2_of_tolerance(asked.options));
        typename Sys::state start;
        std::copy_n(asked.state.begin(), start.size(), start.begin());
        stepper.start(asked.t0, start);
        result = visit(stepper);
      }
    });
  });
  return {result.ended, result.steps, result.evaluations, result.reached};
}

auto polls_of(receiver& to) {
  return [&to](double t, std::int64_t) { return to.go_on(t); };
}

run_end solve(const request& asked, receiver& to) {
  std::span<const double> times = asked.times;
  if (asked.own_steps) times = {};
  const bool at_start = times.empty() || times[0] == asked.t0;
  if (at_start) to.output(0, asked.t0, asked.state.data());  // the given state, bit for bit
  if (asked.end() == asked.t0) return {outcome::reached_end, 0, 0, asked.t0};
  return with_stepper(asked, [&]<class Stepper>(Stepper& stepper) {
    adaptive_run<Stepper> run(stepper, asked.t0, asked.end(), asked.events);
    const bool bounded = asked.own_steps && !asked.options.max_steps;
    reporter<adaptive_run<Stepper>> report(times, at_start, to);
    return run.to_end(bounded ? most_own_steps : asked.step_limit(), report, polls_of(to));
  });
}

run_end revisit(const request& asked, const step_memory& from, receiver& to) {
  return with_stepper(asked, [&]<class Stepper>(Stepper& stepper) {
    compensated_point<vec<double, 1>> time;
    typename Stepper::memory memory;
    std::memcpy(&time, from.numbers.data(), sizeof time);
    std::memcpy(static_cast<void*>(&memory), from.numbers.data() + 2, sizeof memory);
    stepper.resume(memory);
    adaptive_run<Stepper> run(stepper, time, asked.end(), asked.direction());
    reporter<adaptive_run<Stepper>> report(asked.times, 0, to);
    return run.to_end(asked.step_limit(), report, polls_of(to));
  });
}

}  // namespace

namespace pendula::PENDULA_MACHINE {
extern const run_kernel adaptive_runs{solve, revisit, nullptr};
}  // namespace pendula::PENDULA_MACHINE
