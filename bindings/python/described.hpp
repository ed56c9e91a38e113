// From a description (system name, form, parameters) to the system in the core.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <vector>

#include "pendula/catalog.hpp"

namespace pendula_python {

struct description {
  std::string system;
  std::size_t form;
  std::vector<double> parameters;
};

// Calls visit(system over double) for what is described.
template <class Visitor>
void with_system(const description& d, Visitor&& visit) {
  const bool found = pendula::with<pendula::systems>(d.system, [&]<class Sys>() {
    if (d.form >= Sys::forms.size() || d.parameters.size() != Sys::forms[d.form].parameters.size())
      throw nanobind::value_error("no such form of this system, or another number of parameters");
    visit(Sys::template make<double>(d.form, d.parameters.data()));
  });
  if (!found) throw nanobind::value_error("no such system in the catalogue");
}

}  // namespace pendula_python
