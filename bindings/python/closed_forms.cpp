// The closed forms and the elliptic functions over arrays.
#include "pendula/kernels/closed_forms.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <array>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "pendula/kernels/elliptic_arrays.hpp"

using namespace pendula_python;
using namespace nb::literals;
using pendula::closed_form, pendula::exact_outcome, pendula::moduli, pendula::system_description;

namespace {

using array_to_fill = nb::ndarray<double, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

const closed_form& closed_form_of(const system_description& of) {
  const closed_form* const found = pendula::closed_form_of(of.name);
  if (!found) throw nb::value_error("no closed form of this system is known");
  return *found;
}

// The same where the motion repeats itself: only then there is a period, an action, one time at an angle.
const closed_form& periodic_form_of(const system_description& of) {
  const closed_form& found = closed_form_of(of);
  if (!found.period) throw nb::value_error("no motion of this system repeats itself");
  return found;
}

void check_pairs(const matrix_in& states) {
  if (states.shape(1) != 2) throw nb::value_error("states must have two columns");
}

// work(watcher) without the GIL, which gives true where it is complete.
template <class Work>
void complete(Work&& work) {
  const auto watch = watching(nb::none());
  bool whole;
  {
    nb::gil_scoped_release without;
    whole = work(watch);
  }
  if (!whole) throw nb::python_error();
}

bool exact(const system_description& of, const matrix_in& states, const array_in& t, double t0,
           const array_to_fill& out) {
  check_pairs(states);
  if (out.shape(0) != states.shape(0) || out.shape(1) != t.shape(0) || out.shape(2) != 2)
    throw nb::value_error("the shapes of states, times and result do not belong together");
  const closed_form& form = closed_form_of(of);
  exact_outcome outcome{};
  complete([&](const pendula::watcher& watch) {
    outcome = form.solve(of.parameters.data(), span_of(states), span_of(t), t0, out.data(), watch);
    return outcome != exact_outcome::stopped;
  });
  return outcome == exact_outcome::complete;
}

array_out exact_derivatives(const system_description& of, const array_in& state, const array_in& t, double t0,
                            const std::vector<std::size_t>& columns) {
  if (state.shape(0) != 2) throw nb::value_error("a state must have two components");
  new_array out({t.shape(0), 2, columns.size()});
  complete([&, form = closed_form_of(of)](const auto& watch) {
    return form.derivatives(of.parameters.data(), state.data(), span_of(t), t0, columns, out.data, watch);
  });
  return out.array;
}

array_out periods(const system_description& of, const matrix_in& states) {
  check_pairs(states);
  new_array out({states.shape(0)});
  complete([&, form = periodic_form_of(of)](const auto& watch) {
    return pendula::periods_of(form, of.parameters.data(), span_of(states), out.data, watch);
  });
  return out.array;
}

array_out actions(const system_description& of, const matrix_in& states) {
  check_pairs(states);
  new_array out({states.shape(0)});
  complete([&, form = periodic_form_of(of)](const auto& watch) {
    return pendula::actions_of(form, of.parameters.data(), span_of(states), out.data, watch);
  });
  return out.array;
}

array_out times_at(const system_description& of, const matrix_in& states, const array_in& theta) {
  check_pairs(states);
  if (theta.shape(0) != states.shape(0)) throw nb::value_error("as many angles as states");
  new_array out({states.shape(0)});
  complete([&, form = periodic_form_of(of)](const auto& watch) {
    return pendula::times_at(form, of.parameters.data(), span_of(states), span_of(theta), out.data, watch);
  });
  return out.array;
}

using of_moduli = bool(const moduli&, double*, const pendula::watcher&);

template <of_moduli* function>
array_out over_moduli(const array_in& values, bool complement) {
  new_array out({values.shape(0)});
  complete([&](const auto& watch) { return function({span_of(values), complement}, out.data, watch); });
  return out.array;
}

array_out elliptic_F(const array_in& phi, const array_in& values, bool complement) {
  if (values.shape(0) != phi.shape(0)) throw nb::value_error("as many moduli as arguments");
  new_array out({values.shape(0)});
  complete([&](const auto& watch) {
    return pendula::incomplete_F_of(span_of(phi), {span_of(values), complement}, out.data, watch);
  });
  return out.array;
}

array_out K_series(const array_in& values, bool complement, long terms) {
  new_array out({values.shape(0)});
  complete(
      [&](const auto& watch) { return pendula::K_series_of({span_of(values), complement}, terms, out.data, watch); });
  return out.array;
}

auto jacobi(const array_in& u, const array_in& values, bool complement) {
  if (values.shape(0) != u.shape(0)) throw nb::value_error("as many moduli as arguments");
  const std::size_t count = u.shape(0);
  new_array am({count}), sn({count}), cn({count}), dn({count});
  complete([&](const auto& watch) {
    return pendula::jacobi_of(span_of(u), {span_of(values), complement}, {am.data, sn.data, cn.data, dn.data}, watch);
  });
  return std::tuple(am.array, sn.array, cn.array, dn.array);
}

}  // namespace

void bind_closed_forms(nb::module_& m) {
  m.attr("largest_start_angle") = pendula::largest_start_angle;
  m.attr("largest_start_speed") = pendula::largest_start_speed;
  m.attr("counted_half_periods") = pendula::counted_half_periods;
  m.attr("most_half_periods") = pendula::most_half_periods;
  m.def("exact", &exact, "description"_a, "states"_a, "t"_a, "t0"_a, "out"_a,
        "States (m, n, 2) at times t (n,) from states (m, 2) at t0, into `out`; false where one is too large.");
  m.def("exact_derivatives", &exact_derivatives, "description"_a, "state"_a, "t"_a, "t0"_a, "columns"_a,
        "Derivatives (n, 2, columns) at times t (n,) of the motion from a state (2,) at t0.");
  m.def("periods", &periods, "description"_a, "states"_a, "Periods of states (m, 2) [s].");
  m.def("actions", &actions, "description"_a, "states"_a, "Actions of states (m, 2) [J s].");
  m.def("times_at", &times_at, "description"_a, "states"_a, "theta"_a,
        "When each state (m, 2) first has its angle (m,) [s].");
  m.def("elliptic_K", &over_moduli<pendula::complete_K_of>, "moduli"_a, "complement"_a,
        "The complete integral of the first kind.");
  m.def("elliptic_E", &over_moduli<pendula::complete_E_of>, "moduli"_a, "complement"_a,
        "The complete integral of the second kind.");
  m.def("elliptic_F", &elliptic_F, "phi"_a, "moduli"_a, "complement"_a, "The incomplete integral of the first kind.");
  m.def("elliptic_K_series", &K_series, "moduli"_a, "complement"_a, "terms"_a,
        "The first terms of the power series of K.");
  m.def("jacobi", &jacobi, "u"_a, "moduli"_a, "complement"_a, "am, sn, cn and dn.");
}
