// One trajectory with a method of fixed step.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>

#include "arrays.hpp"
#include "attendance.hpp"
#include "described.hpp"
#include "pendula/drive/fixed.hpp"
#include "pendula/drive/fixed_kernels.hpp"

using namespace pendula_python;
using namespace nb::literals;

namespace {

struct rows final : pendula_kernels::fixed_receiver {
  rows(double* states, std::size_t dimension, const attendance& attending)
      : states(states), dimension(dimension), attending(attending) {}

  bool output(std::size_t place, const double* y) override {
    std::copy_n(y, dimension, states + place * dimension);
    return true;
  }
  bool go_on(std::int64_t steps) override { return attending(steps); }

  double* states;
  std::size_t dimension;
  const attendance& attending;
};

// (times, states, reached, outcome, steps, evaluations): times (n,) and states (n, d) hold room for every output, of
// which `reached` were reached.
auto solve_fixed(const description& d, const std::string& method, const std::vector<double>& state, double t0,
                 double step, std::int64_t step_limit, const array_in& times, bool own_steps, nb::object progress) {
  const attendance go_on{std::move(progress)};
  const auto plan = own_steps ? pendula::own_steps(t0, step, times.data()[0])
                              : pendula::requested_times(t0, step, {times.data(), times.shape(0)});
  new_array t({plan.outputs.size()}), states({plan.outputs.size(), state.size()});
  std::ranges::copy(plan.times, t.data);
  rows told(states.data, state.size(), go_on);
  pendula_kernels::fixed_outcome result;
  {
    nb::gil_scoped_release released;
    result = pendula_kernels::fixed_plain.run(
        {d.system, d.form, d.parameters.data(), method, state.data(), step, step_limit}, plan.outputs, told);
  }
  const auto ended = static_cast<pendula::outcome>(result.ended);
  if (ended == pendula::outcome::interrupted) throw nb::python_error();
  return std::tuple(t.array, states.array, result.outputs, pendula::name_of(ended), result.steps, result.evaluations);
}

}  // namespace

void bind_solve(nb::module_& m) {
  m.def("solve_fixed", &solve_fixed, "description"_a, "method"_a, "state"_a, "t0"_a, "step"_a, "step_limit"_a,
        "times"_a, "own_steps"_a, "progress"_a.none(),
        "Times, states, how many of both were reached, how the run ended, steps taken and evaluations. `step` is "
        "negative for a run backward; with own_steps the one time is the end.");
}
