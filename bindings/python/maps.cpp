// The cells of flip maps.
#include <nanobind/stl/optional.h>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "pendula/kernels/flip_map.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::flips_found;

namespace {

using bytes_out = nb::ndarray<nb::numpy, std::uint8_t>;

bytes_out bytes_of(const flips_found& owner, const std::vector<std::uint8_t>& numbers) {
  return {const_cast<std::uint8_t*>(numbers.data()), {numbers.size()}, nb::find(owner)};
}

flips_found flips(const pendula::system_description& system, double t_max, double tolerance, int which, bool resolve,
                  const matrix_in& starts, std::size_t threads, nb::object progress) {
  if (which < 0 || which > 2 || starts.shape(1) != 4) throw nb::value_error("not a double pendulum's");
  const auto watch = watching(std::move(progress));
  flips_found found;
  {
    nb::gil_scoped_release without;
    const auto workers = pendula::threads(threads);
    found = pendula::find_flips({system, t_max, tolerance, which, resolve}, span_of(starts), *workers, watch);
  }
  if (found.interrupted) throw nb::python_error();
  return found;
}

}  // namespace

void bind_maps(nb::module_& m) {
  m.attr("second_run_tolerance") = pendula::second_run_tolerance;
  m.attr("flip_agreement") = pendula::flip_agreement;
  nb::class_<flips_found>(m, "Flips", "First flips of a double pendulum's rods.")
      .def_ro("refused", &flips_found::refused, "The fault for which nothing was run; None: it was.")
      .def_prop_ro(
          "time", [](const flips_found& f) { return view(f, f.time, {f.time.size()}); }, "(n,) [s]; NaN: none.")
      .def_prop_ro(
          "rod", [](const flips_found& f) { return bytes_of(f, f.rod); }, "(n,); 0: none.")
      .def_prop_ro(
          "forbidden", [](const flips_found& f) { return bytes_of(f, f.forbidden); },
          "(n,): 1 where the energy is too small for a flip.")
      .def_prop_ro(
          "resolved", [](const flips_found& f) { return bytes_of(f, f.resolved); },
          "(n,): 1 where the second run agrees; empty: not asked.");
  m.def("flips", &flips, "description"_a, "t_max"_a, "tolerance"_a, "which"_a, "resolve"_a, "starts"_a, "threads"_a,
        "progress"_a.none(), "First flips from states (n, 4) at rest.");
}
