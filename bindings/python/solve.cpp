// One trajectory with a method of fixed step.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "attendance.hpp"
#include "described.hpp"
#include "pendula/drive/fixed.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::fixed_output;

namespace {

struct run_arguments {
  std::vector<double> state;
  double step;
  std::int64_t step_limit;
  const std::vector<fixed_output>& outputs;
  const attendance& go_on;
};

template <class Method, class Sys>
  requires pendula::StepsOver<Method, Sys>
pendula::lane_result run(const Sys& system, const run_arguments& given, double* states) {
  typename Sys::state start;
  if (given.state.size() != Sys::dimension)
    throw nb::value_error("another number of components than the system's state");
  std::ranges::copy(given.state, start.begin());
  const auto sink = [&](std::size_t i, const auto& y) { std::ranges::copy(y, states + i * Sys::dimension); };
  nb::gil_scoped_release released;
  pendula::fixed_run<Method, Sys> drive(system, start, given.step, given.step_limit);
  return drive.through(given.outputs, sink, given.go_on)[0];
}

// (times, states, reached, outcome, steps, evaluations): times (n,) and states (n, d) hold room for every output, of
// which `reached` were reached.
auto solve_fixed(const description& d, const std::string& method, const std::vector<double>& state, double t0,
                 double step, std::int64_t step_limit, const array_in& times, bool own_steps, nb::object progress) {
  const attendance go_on{std::move(progress)};
  const auto plan = own_steps ? pendula::own_steps(t0, step, times.data()[0])
                              : pendula::requested_times(t0, step, {times.data(), times.shape(0)});
  new_array t({plan.outputs.size()}), states({plan.outputs.size(), state.size()});
  std::ranges::copy(plan.times, t.data);
  pendula::lane_result result;
  with_system(d, [&](const auto& system) {
    const bool found = pendula::with<pendula::fixed_methods>(method, [&]<class Method>() {
      if constexpr (Method::template takes<std::remove_cvref_t<decltype(system)>>) {
        result = run<Method>(system, {state, step, step_limit, plan.outputs, go_on}, states.data);
      } else {
        throw nb::value_error("a method that does not take this system");
      }
    });
    if (!found) throw nb::value_error("no such method in the catalogue");
  });
  if (result.ended == pendula::outcome::interrupted) throw nb::python_error();
  return std::tuple(t.array, states.array, result.outputs, pendula::name_of(result.ended), result.steps,
                    result.evaluations);
}

}  // namespace

void bind_solve(nb::module_& m) {
  m.def("solve_fixed", &solve_fixed, "description"_a, "method"_a, "state"_a, "t0"_a, "step"_a, "step_limit"_a,
        "times"_a, "own_steps"_a, "progress"_a.none(),
        "Times, states, how many of both were reached, how the run ended, steps taken and evaluations. `step` is "
        "negative for a run backward; with own_steps the one time is the end.");
}
