// The catalogue as Python data, and the physics of its systems over arrays.
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

#include "arrays.hpp"
#include "pendula/drive/fixed_grid.hpp"
#include "pendula/kernels/catalog_rows.hpp"
#include "pendula/kernels/machine.hpp"
#include "pendula/scalar/whole_turns.hpp"
#include "request.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::system_description;

namespace {

nb::list parameter_rows(const pendula::form& form) {
  nb::list rows;
  for (const pendula::parameter& p : form.parameters) {
    nb::dict row;
    row["name"] = text(p.name);
    row["unit"] = text(p.unit);
    row["standard"] = p.standard;
    row["range"] = text(pendula::range_names[static_cast<std::size_t>(p.allowed)]);
    row["meaning"] = text(p.meaning);
    row["same_as"] = text(p.same_as);
    rows.append(row);
  }
  return rows;
}

nb::dict capabilities_of(const pendula::system_row& system) {
  nb::dict row;
  row["conservative"] = system.can.conservative;
  row["autonomous"] = system.can.autonomous;
  row["closed_form"] = system.can.closed_form;
  row["period"] = system.can.period;
  row["mapped"] = system.can.mapped;
  row["periodic"] = system.can.periodic;
  row["degrees_of_freedom"] = system.degrees_of_freedom;
  return row;
}

nb::dict system_row(const pendula::system_row& system) {
  nb::dict row;
  row["name"] = text(system.name);
  nb::list components, forms;
  for (const pendula::component& c : system.components) {
    nb::dict component;
    component["name"] = text(c.name);
    component["unit"] = text(c.unit);
    component["standard"] = c.standard;
    component["meaning"] = text(c.meaning);
    components.append(component);
  }
  for (const pendula::form& f : system.forms) {
    nb::dict form;
    form["name"] = text(f.name);
    form["meaning"] = text(f.meaning);
    form["parameters"] = parameter_rows(f);
    forms.append(form);
  }
  row["components"] = components;
  row["forms"] = forms;
  row["capabilities"] = capabilities_of(system);
  return row;
}

nb::dict method_row(const pendula::method_row& method) {
  nb::dict row;
  row["name"] = text(method.name);
  row["order"] = method.order;
  row["evaluations_per_step"] = method.evaluations_per_step;
  row["adaptive"] = method.adaptive;
  row["symplectic"] = method.symplectic;
  row["needs"] = text(pendula::facet_names[static_cast<std::size_t>(method.needs)]);
  nb::list systems;
  for (const auto name : method.systems) systems.append(text(name));
  row["systems"] = nb::tuple(systems);
  row["source"] = text(method.source);
  row["stability_polynomial"] = nb::tuple(nb::cast(method.stability_polynomial));
  return row;
}

nb::list systems() {
  nb::list rows;
  for (const auto& system : pendula::system_rows()) rows.append(system_row(system));
  return rows;
}

nb::list methods() {
  nb::list rows;
  for (const auto& method : pendula::method_rows()) rows.append(method_row(method));
  return rows;
}

nb::list machines() {
  nb::list names;
  const auto here = static_cast<std::size_t>(pendula::machine_here());
  for (auto i = static_cast<std::size_t>(pendula::least_machine); i <= here; ++i)
    names.append(text(pendula::machine_names[i]));
  return names;
}

array_out rhs(const system_description& of, const matrix_in& states, double t) {
  new_array out({states.shape(0), states.shape(1)});
  nb::gil_scoped_release released;
  pendula::rhs_of(of, t, span_of(states), out.data);
  return out.array;
}

std::tuple<array_out, array_out> energies(const system_description& of, const matrix_in& states) {
  new_array kinetic({states.shape(0)}), potential({states.shape(0)});
  pendula::energies_of(of, span_of(states), kinetic.data, potential.data);
  return {kinetic.array, potential.array};
}

array_out positions(const system_description& of, const matrix_in& states) {
  new_array out({states.shape(0), states.shape(1) / 2, std::size_t{2}});
  pendula::positions_of(of, span_of(states), out.data);
  return out.array;
}

array_out within_range_of_sine(const array_in& angles) {
  new_array out({angles.shape(0)});
  std::transform(angles.data(), angles.data() + angles.shape(0), out.data, pendula::within_range_of_sine);
  return out.array;
}

int series_order(double tolerance) {
  pendula::run_options options;
  options.tolerance = tolerance;
  return pendula::series_order(options);
}

nb::dict constants(const system_description& of) {
  nb::dict named;
  for (const auto& each : pendula::numbers_of(of).constants) named[text(each.name)] = each.value;
  return named;
}

}  // namespace

void bind_catalog(nb::module_& m) {
  m.def("systems", &systems, nb::sig("def systems() -> list[dict[str, typing.Any]]"),
        "The catalogue's systems with their parameters and capabilities.");
  m.def("methods", &methods, nb::sig("def methods() -> list[dict[str, typing.Any]]"), "The catalogue's methods.");
  m.def("machines", &machines, nb::sig("def machines() -> list[str]"),
        "What this processor is of the machines that loops are built for.");
  m.attr("largest_angle") = pendula::largest_angle;
  m.attr("on_grid") = pendula::on_grid;
  m.attr("most_outputs") = static_cast<std::int64_t>(pendula::most_outputs);
  m.def("series_order", &series_order, "tolerance"_a, "The order of the series that the Taylor method takes.");
  m.def("rhs", &rhs, "description"_a, "states"_a, "t"_a, "Time derivative of each state, (n, d).");
  m.def("energies", &energies, "description"_a, "states"_a, "Kinetic and potential energy of each state [J].");
  m.def("positions", &positions, "description"_a, "states"_a, "Bob, or end of each rod, (n, d/2, 2) [m].");
  m.def("within_range_of_sine", &within_range_of_sine, "angles"_a,
        "The same directions, without whole turns where the angle is too large for the sine [rad].");
  m.def("constants", &constants, "description"_a,
        nb::sig("def constants(description: Description) -> dict[str, float]"),
        "The constants that the equations of motion are written in.");
  m.def(
      "scales",
      [](const system_description& of) {
        const auto numbers = pendula::numbers_of(of);
        return std::tuple(numbers.energy_scale, numbers.largest_frequency);
      },
      "description"_a, "Energy scale [J], and the largest frequency of small oscillations [rad/s].");
}
