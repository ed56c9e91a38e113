#include "pendula/kernels/catalog_rows.hpp"

#include <algorithm>
#include <cmath>

#include "pendula/catalog.hpp"
#include "pendula/kernels/wrong_call.hpp"

namespace pendula {

namespace {

template <class Method>
method_row row_of() {
  method_row row{Method::name,
                 Method::order,
                 Method::evaluations_per_step,
                 Method::adaptive,
                 Method::symplectic,
                 Method::needs,
                 {},
                 Method::source,
                 {}};
  for_each<systems>([&]<class Entry>() {
    if constexpr (takes<Method, Entry>) row.systems.push_back(Entry::name);
  });
  if constexpr (requires { Method::stability_polynomial; })
    row.stability_polynomial.assign(Method::stability_polynomial.begin(), Method::stability_polynomial.end());
  return row;
}

// Calls visit(system over double).
template <class Visit>
void with_system(const system_description& of, Visit&& visit) {
  bool found = false;
  with<systems>(of.name, [&]<class Entry>() {
    if (of.form >= Entry::forms.size() || of.parameters.size() != Entry::forms[of.form].parameters.size())
      wrong_call("a form of the system, with as many parameters as it has, is needed");
    visit(Entry::template make<double>(of.form, of.parameters.data()));
    found = true;
  });
  if (!found) wrong_call("no system '" + of.name + "' in the catalogue");
}

// Calls write(system, state, row) for every state.
template <class Write>
void for_each_state(const system_description& of, std::span<const double> states, Write&& write) {
  with_system(of, [&](const auto& system) {
    typename std::remove_cvref_t<decltype(system)>::state y;
    if (states.size() % y.size() != 0) wrong_call("states of another dimension than the system's");
    for (std::size_t row = 0; (row + 1) * y.size() <= states.size(); ++row) {
      std::copy_n(states.data() + row * y.size(), y.size(), y.begin());
      write(system, y, row);
    }
  });
}

}  // namespace

std::span<const system_row> system_rows() {
  static const std::vector<system_row> rows = [] {
    std::vector<system_row> all;
    for_each<systems>([&]<class Entry>() {
      all.push_back({Entry::name, Entry::components, Entry::forms, Entry::can,
                     degrees_of_freedom<typename Entry::template over<double>>});
    });
    return all;
  }();
  return rows;
}

std::span<const method_row> method_rows() {
  static const std::vector<method_row> rows = [] {
    std::vector<method_row> all;
    for_each<methods>([&]<class Method>() { all.push_back(row_of<Method>()); });
    return all;
  }();
  return rows;
}

const system_row* system_named(std::string_view name) {
  const auto rows = system_rows();
  const auto found = std::ranges::find(rows, name, &system_row::name);
  return found == rows.end() ? nullptr : &*found;
}

const method_row* method_named(std::string_view name) {
  const auto rows = method_rows();
  const auto found = std::ranges::find(rows, name, &method_row::name);
  return found == rows.end() ? nullptr : &*found;
}

bool takes_system(const method_row& method, std::string_view system) {
  return std::ranges::find(method.systems, system) != method.systems.end();
}

int series_order(const run_options& options) { return taylor_order(log2_of_tolerance(options)); }

system_numbers numbers_of(const system_description& of) {
  system_numbers numbers{};
  with_system(of, [&](const auto& system) {
    const auto constants = system.constants();
    bool sticks = false;
    if constexpr (Piecewise<std::remove_cvref_t<decltype(system)>>)
      sticks = std::ranges::any_of(system.holding(), [](double torque) { return torque > 0.0; });
    numbers = {{constants.begin(), constants.end()},
               system.energy_scale(),
               std::sqrt(system.largest_frequency_squared()),
               sticks};
  });
  return numbers;
}

void rhs_of(const system_description& of, double t, std::span<const double> states, double* slopes) {
  for_each_state(of, states, [&](const auto& system, const auto& y, std::size_t row) {
    std::ranges::copy(system.rhs(t, y), slopes + row * y.size());
  });
}

void energies_of(const system_description& of, std::span<const double> states, double* kinetic, double* potential) {
  for_each_state(of, states, [&](const auto& system, const auto& y, std::size_t row) {
    kinetic[row] = system.kinetic_energy(y);
    potential[row] = system.potential_energy(y);
  });
}

void positions_of(const system_description& of, std::span<const double> states, double* positions) {
  for_each_state(of, states, [&](const auto& system, const auto& y, std::size_t row) {
    double* to = positions + row * y.size();
    for (const auto& point : system.positions(y)) to = std::ranges::copy(point, to).out;
  });
}

}  // namespace pendula
