// How long a run is right, and runs with more digits than a double has.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <chrono>

#include "arrays.hpp"
#include "attendance.hpp"
#include "described.hpp"
#include "pendula/drive/horizon.hpp"
#include "pendula/drive/long_runs.hpp"

using namespace pendula_python;
using namespace nb::literals;

namespace {

// Asks `attending` some ten times a second, however often it is asked itself.
auto now_and_then(const attendance& attending) {
  using clock = std::chrono::steady_clock;
  return [&attending, last = clock::now()](double t) mutable {
    const auto now = clock::now();
    if (now - last < std::chrono::milliseconds(100)) return true;
    last = now;
    return attending(t);
  };
}

double trust_horizon(const description& d, const std::string& method, const std::vector<double>& state, double t0,
                     double end, double step, double log2_of_tolerance, double certify, nb::object progress) {
  const attendance attending{std::move(progress)};
  std::optional<double> found;
  {
    nb::gil_scoped_release released;
    found = pendula::trust_horizon(
        {d.system, d.form, d.parameters, state, method, t0, end, step, log2_of_tolerance, certify},
        now_and_then(attending));
  }
  if (!found) throw nb::python_error();
  return *found;
}

std::vector<pendula::long_run_kernel> long_run_kernels() {
  std::vector<pendula::long_run_kernel> all;
  for (const auto& each : pendula::shorter_long_runs()) all.push_back(each);
  for (const auto& each : pendula::longer_long_runs()) all.push_back(each);
  return all;
}

std::vector<int> long_run_digits() {
  std::vector<int> digits;
  for (const auto& each : long_run_kernels()) digits.push_back(each.decimal_digits);
  return digits;
}

// (states, outcome): (n, d, 2), each component as a head and a tail.
auto long_run(const description& d, std::size_t level, const std::vector<double>& state, double t0,
              const array_in& times, nb::object progress) {
  const auto kernels = long_run_kernels();
  const std::size_t count = times.shape(0);
  if (level >= kernels.size() || count == 0) throw nb::value_error("no such level, or no times");
  const attendance attending{std::move(progress)};
  new_array states({count, state.size(), std::size_t{2}});
  pendula::outcome ended;
  {
    nb::gil_scoped_release released;
    ended = kernels[level].run({d.system, d.form, d.parameters, state, t0, {times.data(), count}}, states.data,
                               now_and_then(attending));
  }
  if (ended == pendula::outcome::interrupted) throw nb::python_error();
  return std::tuple(states.array, pendula::name_of(ended));
}

}  // namespace

void bind_trust(nb::module_& m) {
  m.def("trust_horizon", &trust_horizon, "description"_a, "method"_a, "state"_a, "t0"_a, "end"_a, "step"_a,
        "log2_of_tolerance"_a, "certify"_a, "progress"_a.none(),
        "First time at which an angle of the run is off by more than `certify`, or infinity. `step` is negative for a "
        "run backward, and 0 for an adaptive method.");
  m.def("long_run_digits", &long_run_digits, "Decimal digits of the levels of `long_run`.");
  m.def("long_run", &long_run, "description"_a, "level"_a, "state"_a, "t0"_a, "times"_a, "progress"_a.none(),
        "States (n, d, 2) at times (n,), which follow one another from t0 on, as heads and tails, and how it ended.");
}
