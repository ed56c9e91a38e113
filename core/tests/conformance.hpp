// What every system and every method has to pass, over any list of systems: the catalogue's, or those of a test.
#pragma once

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "pendula/catalog.hpp"
#include "pendula/drive/fixed.hpp"

namespace conformance {

using namespace pendula;

// When every run starts. It makes no difference where the equations do not depend on time.
inline constexpr double t0 = 3.0;

// Parameters all different, so that none can stand in for another.
inline double some_parameter(const parameter& row, std::size_t i) {
  const bool in_pieces = row.name.starts_with("coulomb") || row.name == "quadratic";  // those have tests of their own
  // what friction takes grows backward in time, and no motion is to be wilder than the ideal ones
  const bool weak = row.unit.starts_with("N m") || row.name == "pivot_amplitude" || row.name == "a";
  const double size = in_pieces ? 0.0 : weak ? 0.02 : row.name == "q" ? 50.0 : 1.0;
  return row.name == "gravity" ? 9.81 : size * (0.7 + 0.13 * static_cast<double>(i));
}

template <class Sys>
typename Sys::state some_state() {
  typename Sys::state y;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = typename Sys::scalar(0.9 - 0.5 * static_cast<double>(i));
  return y;
}

template <class Entry, class S>
auto some_system(std::size_t form) {
  std::vector<S> p;
  for (const parameter& row : Entry::forms[form].parameters) p.push_back(S(some_parameter(row, p.size())));
  return Entry::template make<S>(form, p.data());
}

// Calls visit.operator()<Entry>(system, start) for each form of each system of the list.
template <class List, class Visitor>
void for_each_system(Visitor&& visit) {
  for_each<List>([&]<class Entry>() {
    static_assert(SystemEntry<Entry>);
    for (std::size_t form = 0; form < Entry::forms.size(); ++form)
      BOOST_TEST_CONTEXT(Entry::name << " " << Entry::forms[form].name) {
        visit.template operator()<Entry>(some_system<Entry, double>(form),
                                         some_state<typename Entry::template over<double>>());
      }
  });
}

// Calls visit.operator()<Method>() for the methods of the list that take the system.
template <class Methods, class Sys, class Visitor>
void for_each_method(Visitor&& visit) {
  for_each<Methods>([&]<class Method>() {
    if constexpr (Takes<Method, Sys>) {
      BOOST_TEST_CONTEXT(Method::name) { visit.template operator()<Method>(); }
    }
  });
}

// From `start` at time `from`, so many steps on, in all a time `span`.
template <class Method, class Sys>
typename Sys::state after(const Sys& system, const typename Sys::state& start, double from, double span,
                          std::int64_t steps) {
  typename Sys::state end{};
  const fixed_output last[] = {{steps, 0.0}};
  fixed_run<Method, Sys>(system, start, from, span / static_cast<double>(steps), steps)
      .through(last, [&](std::size_t, const auto& y) { end = y; }, [](auto) { return true; });
  return end;
}

template <class State>
double distance(const State& a, const State& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const double apart = std::fabs(a[i] - b[i]); !(apart <= most)) most = apart;  // not a number is far, too
  return most;
}

template <class Sys>
double energy_of(const Sys& system, const typename Sys::state& y) {
  return system.kinetic_energy(y) + system.potential_energy(y);
}

// The order that a method shows from t0 to t0 + 1, with steps whose errors are small enough for it to show, and still
// far above rounding.
template <class Method, class Sys>
double order_shown(const Sys& system, const typename Sys::state& start, const typename Sys::state& truth) {
  const double small = Method::order == 1 ? 1e-4 : Method::order == 2 ? 1e-6 : 1e-11;
  const auto error = [&](std::int64_t steps) { return distance(after<Method>(system, start, t0, 1.0, steps), truth); };
  std::int64_t steps = 8;
  while (steps < 1 << 17 && !(error(2 * steps) < small)) steps *= 2;
  return std::log2(error(steps) / error(2 * steps));
}

template <class Method, class Sys>
void check_order(const Sys& system, const typename Sys::state& start, const typename Sys::state& truth) {
  const double order = order_shown<Method>(system, start, truth);
  BOOST_TEST(std::fabs(order - Method::order) < (Method::order == 8 ? 0.25 : 0.1), order);
}

template <class List>
void every_method_converges_with_its_order() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    const auto truth = after<rk4>(system, start, t0, 1.0, 1 << 14);
    for_each_method<fixed_methods, Sys>([&]<class Method>() { check_order<Method>(system, start, truth); });
  });
}

template <class List>
void every_method_goes_back_where_it_came_from() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    for_each_method<fixed_methods, Sys>([&]<class Method>() {
      const std::int64_t steps = 256;
      const auto there = after<Method>(system, start, t0, 0.5, steps),
                 back = after<Method>(system, there, t0 + 0.5, -0.5, steps);
      // the symmetric ones are those of even order that are symplectic; of the rest their own error is left
      constexpr bool symmetric = Method::symplectic && Method::order % 2 == 0;
      const double own_error = symmetric ? 0.0 : 50.0 * std::pow(0.5 / steps, Method::order);
      BOOST_TEST(distance(back, start) < own_error + 2e-14, distance(back, start));
    });
  });
}

template <class List>
void every_system_conserves_its_energy_where_it_says_so() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    const double before = energy_of(system, start),
                 change = energy_of(system, after<rk4>(system, start, t0, 2.0, 1 << 15)) / before - 1.0;
    BOOST_TEST(before > 0.0);
    BOOST_TEST((std::fabs(change) < 1e-12) == Entry::can.conservative, change);
  });
}

template <class List>
void every_system_rests_at_the_lowest_point() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto&) {
    const typename Sys::state rest{};
    if (Entry::can.autonomous) BOOST_TEST(distance(system.rhs(t0, rest), rest) == 0.0);
    BOOST_TEST(energy_of(system, rest) == 0.0);
  });
}

// The ends are where the angles say: each as far from the one before as its rod is long, whatever the angles.
template <class List>
void every_system_keeps_its_lengths() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    for (const auto& y : {start, after<rk4>(system, start, t0, 1.0, 1 << 12)}) {
      vec<double, 2> previous{0.0, 0.0};
      for (std::size_t i = 0; i < system.lengths().size(); ++i) {
        const auto end = system.positions(y)[i];
        const double found = std::hypot(end[0] - previous[0], end[1] - previous[1]);
        BOOST_TEST(std::fabs(found - system.lengths()[i]) < 1e-14);
        previous = end;
      }
    }
  });
}

// Canonical variables say the same as the state: there and back.
template <class List>
void canonical_variables_lead_back_to_the_state() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    BOOST_TEST(distance(system.from_canonical(system.canonical(start)), start) < 4e-16);
  });
}

// And they have the same right-hand side: along the flow, p changes as the forces say.
template <class List>
void canonical_variables_are_those_of_the_motion() {
  for_each_system<List>([]<class Entry, class Sys>(const Sys& system, const auto& start) {
    const auto z = system.canonical(start);
    const double h = 1e-5;
    const auto slope = system.rhs(t0, start);
    auto before = start, behind = start;
    for (std::size_t i = 0; i < start.size(); ++i) {
      before[i] = start[i] - h * slope[i];
      behind[i] = start[i] + h * slope[i];
    }
    const auto from = system.canonical(before), to = system.canonical(behind);
    constexpr std::size_t n = degrees_of_freedom<Sys>;
    vec<double, n> angles, momenta;
    std::copy_n(z.begin(), n, angles.begin());
    std::copy_n(z.begin() + n, n, momenta.begin());
    const auto at = system.configuration_at(angles);
    const auto velocities = system.velocities(at, momenta), forces = system.forces(t0, at, velocities);
    for (std::size_t i = 0; i < n; ++i) {
      BOOST_TEST(std::fabs(velocities[i] - start[n + i]) < 1e-14);
      BOOST_TEST(std::fabs((to[n + i] - from[n + i]) / (2.0 * h) - forces[i]) < 1e-9);
    }
  });
}

}  // namespace conformance
