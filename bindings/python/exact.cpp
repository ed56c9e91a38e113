// The closed-form solutions over arrays.
#include "pendula/kernels/exact.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "pendula/exact/simple_times.hpp"

using namespace pendula_python;
using namespace nb::literals;

namespace {

using array_to_fill = nb::ndarray<double, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

pendula::exact_request request(double length, double gravity, const matrix_in& states, const array_in& t, double t0,
                               const array_to_fill& out) {
  if (states.shape(1) != 2 || out.shape(0) != states.shape(0) || out.shape(1) != t.shape(0) || out.shape(2) != 2)
    throw nb::value_error("the shapes of states, times and result do not belong together");
  return {length, gravity, states.data(), states.shape(0), t.data(), t.shape(0), t0};
}

// Python's signal handlers run here; one that raises ends the work.
bool no_signal() {
  nb::gil_scoped_acquire held;
  return PyErr_CheckSignals() == 0;
}

// Whether all could be computed.
template <class Solve>
bool solved(Solve&& solve) {
  pendula::exact_outcome outcome;
  {
    nb::gil_scoped_release released;
    outcome = solve();
  }
  if (outcome == pendula::exact_outcome::stopped) throw nb::python_error();
  return outcome == pendula::exact_outcome::complete;
}

bool exact_simple(double length, double gravity, const matrix_in& states, const array_in& t, double t0,
                  const array_to_fill& out) {
  const auto asked = request(length, gravity, states, t, t0, out);
  return solved([&] { return pendula::exact_simple(*pendula::all_exact().back(), asked, out.data(), no_signal); });
}

bool exact_linear(double length, double gravity, const matrix_in& states, const array_in& t, double t0,
                  const array_to_fill& out) {
  const auto asked = request(length, gravity, states, t, t0, out);
  return solved([&] { return pendula::exact_linear(*pendula::all_exact().back(), asked, out.data(), no_signal); });
}

// f(θ, ω) of each state; f takes a millisecond at most.
template <class Function>
array_out of_each_state(const matrix_in& states, Function&& f) {
  if (states.shape(1) != 2) throw nb::value_error("states must have two columns");
  new_array out({states.shape(0)});
  bool going_on = true;
  {
    nb::gil_scoped_release released;
    for (std::size_t i = 0; i < states.shape(0) && going_on; ++i) {
      out.data[i] = f(states.data() + 2 * i, i);
      if (i % 256 == 255) going_on = no_signal();
    }
  }
  if (!going_on) throw nb::python_error();
  return out.array;
}

array_out simple_period(double length, double gravity, const matrix_in& states) {
  return of_each_state(
      states, [&](const double* y, std::size_t) { return pendula::simple_period(length, gravity, y[0], y[1]); });
}

array_out simple_action(double length, double gravity, double mass, const matrix_in& states) {
  return of_each_state(
      states, [&](const double* y, std::size_t) { return pendula::simple_action(length, gravity, mass, y[0], y[1]); });
}

using time_at_function = double(double, double, double, double, double);

template <time_at_function* time_at>
array_out times_at(double length, double gravity, const matrix_in& states, const array_in& theta) {
  if (theta.shape(0) != states.shape(0)) throw nb::value_error("as many angles as states");
  return of_each_state(
      states, [&](const double* y, std::size_t i) { return time_at(length, gravity, y[0], y[1], theta.data()[i]); });
}

}  // namespace

void bind_exact(nb::module_& m) {
  m.attr("largest_start_angle") = pendula::largest_start_angle;
  m.attr("largest_start_speed") = pendula::largest_start_speed;
  m.attr("counted_half_periods") = pendula::counted_half_periods;
  m.attr("most_half_periods") = pendula::most_half_periods;
  m.def("exact_linear", &exact_linear, "length"_a, "gravity"_a, "states"_a, "t"_a, "t0"_a, "out"_a,
        "States (m, n, 2) of the linear pendulum at times t from states (m, 2) at t0; false where t is too large.");
  m.def("exact_simple", &exact_simple, "length"_a, "gravity"_a, "states"_a, "t"_a, "t0"_a, "out"_a,
        "States (m, n, 2) of the simple pendulum at times t from states (m, 2) at t0; false where one is too large.");
  m.def("simple_period", &simple_period, "length"_a, "gravity"_a, "states"_a, "Periods of states (m, 2).");
  m.def("simple_action", &simple_action, "length"_a, "gravity"_a, "mass"_a, "states"_a, "Actions of states (m, 2).");
  m.def("simple_time_at", &times_at<pendula::simple_time_at>, "length"_a, "gravity"_a, "states"_a, "theta"_a,
        "When each state (m, 2) first has its angle (m,).");
  m.def("linear_time_at", &times_at<pendula::linear_time_at>, "length"_a, "gravity"_a, "states"_a, "theta"_a,
        "The same of the linear pendulum.");
}
