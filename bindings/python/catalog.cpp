// The catalogue as Python data: what exists, with names, units, ranges and sources.
#include "pendula/catalog.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include "pendula/drive/machine.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace {

nb::str text(std::string_view s) { return nb::str(s.data(), s.size()); }

nb::list parameter_rows(const pendula::form& form) {
  nb::list rows;
  for (const pendula::parameter& p : form.parameters) {
    nb::dict row;
    row["name"] = text(p.name);
    row["unit"] = text(p.unit);
    row["standard"] = p.standard;
    row["zero_allowed"] = p.zero_allowed;
    row["meaning"] = text(p.meaning);
    row["same_as"] = text(p.same_as);
    rows.append(row);
  }
  return rows;
}

template <class Sys>
nb::dict system_row() {
  nb::dict row;
  row["name"] = text(Sys::name);
  nb::list components, forms;
  for (const pendula::component& c : Sys::components) {
    nb::dict component;
    component["name"] = text(c.name);
    component["unit"] = text(c.unit);
    component["standard"] = c.standard;
    component["meaning"] = text(c.meaning);
    components.append(component);
  }
  for (const pendula::form& f : Sys::forms) {
    nb::dict form;
    form["name"] = text(f.name);
    form["meaning"] = text(f.meaning);
    form["parameters"] = parameter_rows(f);
    forms.append(form);
  }
  row["components"] = components;
  row["forms"] = forms;
  return row;
}

template <class Method>
nb::dict method_row() {
  nb::dict row;
  row["name"] = text(Method::name);
  row["order"] = Method::order;
  row["evaluations_per_step"] = Method::evaluations_per_step;
  row["adaptive"] = Method::adaptive;
  row["symplectic"] = Method::symplectic;
  nb::list systems;
  pendula::for_each<pendula::systems>([&]<class Sys>() {
    if constexpr (pendula::takes<Method, Sys>) systems.append(text(Sys::name));
  });
  row["systems"] = nb::tuple(systems);
  row["source"] = text(Method::source);
  return row;
}

}  // namespace

void bind_catalog(nb::module_& m) {
  m.def(
      "systems",
      [] {
        nb::list rows;
        pendula::for_each<pendula::systems>([&]<class Sys>() { rows.append(system_row<Sys>()); });
        return rows;
      },
      nb::sig("def systems() -> list[dict[str, typing.Any]]"),
      "The catalogue's systems with the rows of their parameters.");
  m.def(
      "methods",
      [] {
        nb::list rows;
        pendula::for_each<pendula::methods>([&]<class Method>() { rows.append(method_row<Method>()); });
        return rows;
      },
      nb::sig("def methods() -> list[dict[str, typing.Any]]"), "The catalogue's methods.");
  m.def(
      "machines",
      [] {
        nb::list names;
        const auto here = static_cast<std::size_t>(pendula_kernels::machine_here());
        for (std::size_t i = 0; i <= here; ++i) names.append(text(pendula_kernels::machine_names[i]));
        return names;
      },
      nb::sig("def machines() -> list[str]"), "What this processor is of the machines that loops are built for.");
}
