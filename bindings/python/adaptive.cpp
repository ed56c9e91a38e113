// One trajectory with a method that chooses its steps, and its dense output.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include <algorithm>

#include "arrays.hpp"
#include "attendance.hpp"
#include "described.hpp"
#include "events.hpp"
#include "pendula/drive/adaptive_kernels.hpp"
#include "pendula/drive/outcome.hpp"

using namespace pendula_python;
using namespace nb::literals;
using namespace pendula_kernels;

namespace {

const adaptive& best_kernels() { return *all_adaptive().back(); }

// What was asked for, kept alive: the core's request has views only.
struct adaptive_run_of {
  description of;
  std::string method;
  std::vector<double> state;
  double t0, end, log2_of_tolerance;
  std::int64_t step_limit;

  adaptive_request request() const {
    return {of.system, of.form, of.parameters.data(), method, state.data(), t0, end, log2_of_tolerance, step_limit};
  }
};

// Starts of steps, from which the motion between can be worked out again: all of them, or every so many.
class step_starts {
 public:
  void add(const step_memory& start) {
    if (counted_++ % stride_ != 0) return;
    if (starts_.size() == most) {
      for (std::size_t i = 0; 2 * i < most; ++i) starts_[i] = starts_[2 * i];
      starts_.resize(most / 2);
      stride_ *= 2;
      if ((counted_ - 1) % stride_ != 0) return;
    }
    starts_.push_back(start);
  }
  std::size_t size() const { return starts_.size(); }
  const step_memory& operator[](std::size_t i) const { return starts_[i]; }
  double time(std::size_t i) const { return starts_[i][0]; }

 private:
  static constexpr std::size_t most = std::size_t{1} << 14;  // 3 MB
  std::vector<step_memory> starts_;
  std::int64_t stride_ = 1, counted_ = 0;
};

struct rows_of_states {
  std::vector<double> times, states;

  void add(double t, const double* y, std::size_t dimension) {
    times.push_back(t);
    states.insert(states.end(), y, y + dimension);
  }
  nb::tuple arrays(std::size_t dimension) const {
    new_array t({times.size()}), y({times.size(), dimension});
    std::ranges::copy(times, t.data);
    std::ranges::copy(states, y.data);
    return nb::make_tuple(t.array, y.array);
  }
};

struct kept : receiver {
  kept(std::size_t dimension, std::size_t events, const attendance& go_on)
      : dimension(dimension), crossings(events), attending(go_on) {}

  void output(double t, const double* y) override { outputs.add(t, y, dimension); }
  void event(int place, double t, const double* y) override { crossings[place].add(t, y, dimension); }
  void step(const step_memory& start) override { starts.add(start); }
  bool go_on(double t, std::int64_t) override { return attending(t); }

  std::size_t dimension;
  rows_of_states outputs;
  std::vector<rows_of_states> crossings;
  step_starts starts;
  const attendance& attending;
};

// States at any times of a run that was made.
class dense_output {
 public:
  dense_output(adaptive_run_of run, step_starts starts, double reached)
      : reached(reached), run_(std::move(run)), starts_(std::move(starts)) {}

  const double reached;  // the time up to which the run was made

  // Times follow one another in the direction of the run. One next to the end of a step is left to the step before,
  // which goes on to the next if the run itself did.
  array_out at(const array_in& times) const {
    const std::size_t d = run_.state.size(), count = times.shape(0);
    const double* const t = times.data();
    new_array states({count, d});
    const attendance attending{nb::none()};
    nb::gil_scoped_release released;
    const double direction = run_.end < run_.t0 ? -1.0 : 1.0;
    for (std::size_t i = 0, from = 0; i < count;) {
      if (t[i] == run_.t0) {
        std::ranges::copy(run_.state, states.data + d * i++);
        continue;
      }
      while (from + 1 < starts_.size() && direction * starts_.time(from + 1) < direction * t[i]) ++from;
      std::size_t next = i + 1;
      const bool is_last = from + 1 == starts_.size();
      while (next < count && (is_last || direction * t[next] <= direction * starts_.time(from + 1))) ++next;
      writer to(states.data + d * i, d, attending);
      const auto how = best_kernels().revisit(run_.request(), starts_[from], {t + i, next - i}, to).ended;
      if (static_cast<pendula::outcome>(how) == pendula::outcome::interrupted) {
        nb::gil_scoped_acquire held;
        throw nb::python_error();
      }
      i = next;
    }
    return states.array;
  }

 private:
  struct writer : receiver {
    writer(double* to, std::size_t dimension, const attendance& attending)
        : to(to), dimension(dimension), attending(attending) {}
    void output(double, const double* y) override { to = std::copy_n(y, dimension, to); }
    void event(int, double, const double*) override {}
    void step(const step_memory&) override {}
    bool go_on(double t, std::int64_t) override { return attending(t); }
    double* to;
    std::size_t dimension;
    const attendance& attending;
  };

  adaptive_run_of run_;
  step_starts starts_;
};

any_tuple solve_adaptive(const description& d, const std::string& method, const std::vector<double>& state, double t0,
                         double end, double log2_of_tolerance, std::int64_t step_limit,
                         const std::optional<array_in>& times, const std::vector<any_tuple>& events,
                         nb::object progress) {
  const adaptive_run_of run{d, method, state, t0, end, log2_of_tolerance, step_limit};
  const std::vector<event_row> rows = events_of(events);
  const attendance go_on{std::move(progress)};
  kept told(state.size(), rows.size(), go_on);
  std::span<const double> asked;
  if (times) asked = {times->data(), times->shape(0)};
  adaptive_outcome result;
  {
    nb::gil_scoped_release released;
    result = best_kernels().solve(run.request(), asked, rows, told);
  }
  const auto ended = static_cast<pendula::outcome>(result.ended);
  if (ended == pendula::outcome::interrupted) throw nb::python_error();
  nb::list crossings;
  for (const rows_of_states& each : told.crossings) crossings.append(each.arrays(state.size()));
  const nb::tuple outputs = told.outputs.arrays(state.size());
  return nb::make_tuple(outputs[0], outputs[1], pendula::name_of(ended), result.steps, result.evaluations, crossings,
                        dense_output(run, std::move(told.starts), result.reached));
}

}  // namespace

void bind_adaptive(nb::module_& m) {
  nb::class_<dense_output>(m, "DenseOutput", "The motion inside the steps of a run that was made.")
      .def_ro("reached", &dense_output::reached, "The time up to which the run was made [s].")
      .def("at", &dense_output::at, "times"_a, "States (n, d) at times (n,) in the direction of the run.");
  m.def("solve_adaptive", &solve_adaptive, "description"_a, "method"_a, "state"_a, "t0"_a, "end"_a,
        "log2_of_tolerance"_a, "step_limit"_a, "times"_a.none(), "events"_a, "progress"_a.none(),
        "Times, states, how the run ended, steps, evaluations, (times, states) of each event, and the dense output. "
        "Without times the outputs are the steps'.");
}
