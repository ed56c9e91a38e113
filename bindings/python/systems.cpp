// Right-hand side, energies and positions of many states at once, in the core's own arithmetic.
#include <nanobind/stl/tuple.h>

#include <algorithm>

#include "arrays.hpp"
#include "described.hpp"
#include "pendula/scalar/whole_turns.hpp"

using namespace pendula_python;
using namespace nb::literals;

namespace {

// Calls write(system, state, row) for every row of the matrix.
template <class Write>
void for_each_state(const description& d, const matrix_in& states, Write&& write) {
  with_system(d, [&](const auto& system) {
    using Sys = std::remove_cvref_t<decltype(system)>;
    if (states.shape(1) != Sys::dimension)
      throw nb::value_error("another number of components than the system's state");
    const double* from = states.data();
    const std::size_t rows = states.shape(0);
    nb::gil_scoped_release released;
    for (std::size_t row = 0; row < rows; ++row, from += Sys::dimension) {
      typename Sys::state y;
      std::copy_n(from, Sys::dimension, y.begin());
      write(system, y, row);
    }
  });
}

array_out rhs(const description& d, const matrix_in& states) {
  new_array out({states.shape(0), states.shape(1)});
  for_each_state(d, states, [&](const auto& system, const auto& y, std::size_t row) {
    std::ranges::copy(system.rhs(y), out.data + row * y.size());
  });
  return out.array;
}

std::tuple<array_out, array_out> energies(const description& d, const matrix_in& states) {
  new_array kinetic({states.shape(0)}), potential({states.shape(0)});
  for_each_state(d, states, [&](const auto& system, const auto& y, std::size_t row) {
    kinetic.data[row] = system.kinetic_energy(y);
    potential.data[row] = system.potential_energy(y);
  });
  return {kinetic.array, potential.array};
}

array_out positions(const description& d, const matrix_in& states) {
  const std::size_t points = states.shape(1) / 2;
  new_array out({states.shape(0), points, 2});
  for_each_state(d, states, [&](const auto& system, const auto& y, std::size_t row) {
    double* to = out.data + row * points * 2;
    for (const auto& point : system.positions(y)) to = std::ranges::copy(point, to).out;
  });
  return out.array;
}

array_out within_range_of_sine(const array_in& angles) {
  new_array out({angles.shape(0)});
  std::transform(angles.data(), angles.data() + angles.shape(0), out.data, pendula::within_range_of_sine);
  return out.array;
}

// The numbers the equations are written in, by name; all have to be finite for a run to make sense.
nb::dict constants(const description& d) {
  nb::dict named;
  with_system(d, [&](const auto& system) {
    for (const auto& [name, value] : system.constants()) named[nb::str(name.data(), name.size())] = value;
  });
  return named;
}

}  // namespace

void bind_systems(nb::module_& m) {
  m.attr("largest_angle") = pendula::largest_angle;
  nb::class_<description>(m, "Description", "A system's name, the index of its form, and that form's parameters.")
      .def(nb::init<std::string, std::size_t, std::vector<double>>(), "system"_a, "form"_a, "parameters"_a);
  m.def("rhs", &rhs, "description"_a, "states"_a, "Time derivative of each state, (n, d).");
  m.def("energies", &energies, "description"_a, "states"_a, "Kinetic and potential energy of each state [J].");
  m.def("within_range_of_sine", &within_range_of_sine, "angles"_a,
        "The same directions, without whole turns where the angle is too large for the sine [rad].");
  m.def("positions", &positions, "description"_a, "states"_a, "Bob, or end of each rod, (n, d/2, 2) [m].");
  m.def("constants", &constants, "description"_a,
        nb::sig("def constants(description: Description) -> dict[str, float]"),
        "The constants that the equations of motion are written in.");
}
